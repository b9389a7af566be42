#!/usr/bin/env python3
"""How soon `mimicry serve` answers a new client while others hold it. usage: serve_bench.py MIMICRY [STUDIO]

Prints a table in Markdown: the median and the largest time of 100 GETs, each over a connection of its own, and the server's memory.
"""
import contextlib
import http.client
import pathlib
import re
import resource
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time

kHalf = [b"G", b"GET / HTTP/1.1\r\nHo", b"GET / HTTP/1.1\r\nHost: localhost\r\nX: "]


def get_ms(port):
    began = time.monotonic()
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    connection.request("GET", "/")
    assert connection.getresponse().read()
    connection.close()
    return 1000 * (time.monotonic() - began)


def row(name, port, process):
    times = [get_ms(port) for _ in range(100)]
    memory = re.search(r"VmRSS:\s+(\d+)", pathlib.Path(f"/proc/{process.pid}/status").read_text())[1]
    print(f"| {name} | {statistics.median(times):.1f} | {max(times):.1f} | {int(memory) / 1000:.0f} |")


def main():
    program = sys.argv[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(8192, resource.getrlimit(resource.RLIMIT_NOFILE)[1]),) * 2)
    with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as held:
        work = pathlib.Path(folder)
        studio = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else work / "studio"
        if len(sys.argv) <= 2:
            studio.mkdir()
            (studio / "index.html").write_text("<!doctype html>")
        subprocess.run([program, "shapes", "torus", "--resolution", "200", "--out", str(work / "torus.obj")], check=True, stdout=subprocess.DEVNULL)
        process = subprocess.Popen([program, "serve", "--port", "0", "--studio", str(studio), "--data", str(work / "data")],
                                   stdout=subprocess.PIPE, text=True)
        port = int(re.search(r"127\.0\.0\.1:(\d+)/", process.stdout.readline())[1])

        def hold(first=b""):
            s = held.enter_context(socket.create_connection(("127.0.0.1", port)))
            s.sendall(first)

        print("| held | median ms | largest ms | memory MB |\n| --- | --- | --- | --- |")
        row("nothing", port, process)
        for _ in range(1000):
            hold()
        for n in range(200):
            hold(kHalf[n % 3])
        row("1,000 idle and 200 half-sent connections", port, process)
        for _ in range(8):
            hold(b"POST /api/bake?name=a.obj HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100000000\r\n\r\nv 0 0 0\n")
        row("and 8 slow uploads", port, process)
        mesh = (work / "torus.obj").read_bytes()
        hold(b"POST /api/bake?name=torus.obj HTTP/1.1\r\nHost: localhost\r\nContent-Length: %d\r\n\r\n" % len(mesh) + mesh)
        time.sleep(1)
        row("and a bake", port, process)
        process.send_signal(signal.SIGINT)
        process.wait(timeout=30)


if __name__ == "__main__":
    main()
