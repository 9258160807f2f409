#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# What the program $1 ends with: 0, or 2 if its words or the files that they name are wrong.
failed=0
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
expect() {
  code=$1
  shift
  "$program" "$@" >"$folder/out" 2>&1
  got=$?
  [ $got -eq "$code" ] && return
  failed=1
  echo "foretrack $*: ended with $got, $code expected:"
  cat "$folder/out"
}
program=$1
printf 'planning:\n  speed_max_m_s: 3.0\nplanning:\n  speed_max_m_s: 1.0\n' >"$folder/twice.yaml"
printf 'planning:\n  speed_max_m_s: 3.0\n---\nplanning: {}\n' >"$folder/documents.yaml"
printf 'hello' >"$folder/not.bt"
expect 0 --version
expect 0 --help
expect 0 fly --help
expect 2
expect 2 flie
expect 2 fly --speedd 3
expect 2 fly --for soon
expect 2 fly --scenario nope
expect 2 fly --track "$folder/nothing.xy"
expect 2 params --params "$folder/twice.yaml"
expect 2 params --params "$folder/documents.yaml"
expect 2 params flying
expect 2 map "$folder/not.bt"
expect 2 perceive
expect 2 perceive --modell lite
exit $failed
