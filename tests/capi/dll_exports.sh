#!/usr/bin/env bash
# dll_exports.sh OBJDUMP DLL IMPORT_LIBRARY HEADER: the library exports the functions that the header
# declares and no others, needs no library but the system's, and its import library names it.
set -euo pipefail
objdump=$1 dll=$2 import=$3 header=$4
exported=$("$objdump" -p "$dll" | sed -n '/Ordinal\/Name Pointer/,/^$/p' | awk '/^[[:space:]]*\[ *[0-9]+\]/ { print $NF }' | sort)
declared=$(grep -o '\bmimicry_[a-z_]*(' "$header" | tr -d '(' | sort -u)
diff <(echo "$declared") <(echo "$exported")
needs=$("$objdump" -p "$dll" | sed -n 's/.*DLL Name: //p')
[ -n "$needs" ]
if grep -vixE 'kernel32\.dll|msvcrt\.dll|user32\.dll|advapi32\.dll|shell32\.dll|ucrtbase\.dll|api-ms-win-.*' <<<"$needs"; then
  echo "$dll: needs these libraries, which Windows does not have" >&2
  exit 1
fi
strings "$import" | grep -q "^$(basename "$dll")$"
