#!/usr/bin/env bash
# Every tracked C++ file is as clang-format 14 writes it. Exit 77 (skipped) without the tool or outside a git checkout.
set -euo pipefail
cd "${1:?usage: check_format.sh SOURCE_DIR}"
command -v clang-format >/dev/null || { echo "skipped: no clang-format"; exit 77; }
command -v git >/dev/null && git rev-parse --is-inside-work-tree >/dev/null 2>&1 ||
    { echo "skipped: not a git checkout"; exit 77; }
version="$(clang-format --version | sed -n 's/.*version \([0-9]*\).*/\1/p')"
[ "$version" = 14 ] || { echo "skipped: clang-format $version formats differently from 14"; exit 77; }
mapfile -t files < <(git ls-files -- '*.h' '*.cpp' | while read -r f; do [ -f "$f" ] && echo "$f"; done)
[ "${#files[@]}" -gt 0 ] || { echo "no sources are tracked"; exit 1; }
if ! clang-format --dry-run -Werror "${files[@]}"; then
    echo "Run: clang-format -i \$(git ls-files '*.h' '*.cpp')"
    exit 1
fi
echo "${#files[@]} files are formatted"
