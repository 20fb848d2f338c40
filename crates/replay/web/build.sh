#!/usr/bin/env bash
# Makes dist/ from src/: the page's program and style, minified, and the licence of what is bundled.
# Needs node 20 or newer and the npm registry; dist/ is committed, so that cargo needs neither.
# `./build.sh --check` says whether dist/ is what src/ gives, and changes nothing.
set -euo pipefail
cd "$(dirname "$0")"

out=dist
if [ "${1:-}" = --check ]; then
  out=$(mktemp -d)
  trap 'rm -rf "$out"' EXIT
fi
[ -d node_modules/three ] && [ -d node_modules/esbuild ] || npm ci --no-audit --no-fund

npx tsc --project tsconfig.json
npx esbuild src/main.ts --bundle --minify --format=iife --target=es2022 --charset=ascii \
  --legal-comments=none --log-level=warning --outfile="$out/replay.js"
npx esbuild src/style.css --minify --log-level=warning --outfile="$out/replay.css"
version=$(node -p 'require("./node_modules/three/package.json").version')
{
  echo "This page contains three.js $version (https://threejs.org), under this licence:"
  echo
  cat node_modules/three/LICENSE
} >"$out/LICENSES.txt"

if [ "$out" != dist ]; then
  for file in replay.js replay.css LICENSES.txt; do
    cmp "$out/$file" "dist/$file" || { echo "dist/$file is stale: run crates/replay/web/build.sh" >&2; exit 1; }
  done
fi
ls -l "$out" | awk 'NR > 1 { print $5, $9 }'
