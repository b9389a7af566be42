#!/usr/bin/env bash
# Every C++ file stands as .clang-format says.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
find include src examples tests bench fuzz -name '*.h' -o -name '*.cpp' | xargs clang-format --dry-run -Werror
