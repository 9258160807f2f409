#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# try_packages.sh FOLDER: installs, upgrades, removes and purges build/packages/*.deb in a fresh Debian 12 under
# FOLDER (made by debootstrap, 3 GB with what the packages need), and flies there. Needs root and a network; no
# container engine, no systemd. FOLDER is kept, and used again the next time.
set -euo pipefail
root=$(realpath -m "${1:?FOLDER}")
packages=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../build/packages" && pwd)
say() { printf '\033[1m%s\033[0m\n' "$*"; }
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }
fail() { echo "FAILED: $*" >&2; exit 1; }

[ -x "$root/usr/bin/apt-get" ] || debootstrap --variant=minbase bookworm "$root" http://deb.debian.org/debian
for place in proc dev sys; do
  mountpoint -q "$root/$place" || mount --rbind "/$place" "$root/$place"
done
trap 'for place in proc dev sys; do umount -R -l "$root/$place" || true; done' EXIT
cp /etc/resolv.conf "$root/etc/resolv.conf"
rm -rf "$root/debs" && mkdir "$root/debs" && cp "$packages"/*.deb "$root/debs"

say "Install"
inside apt-get update -q
inside sh -c 'apt-get install -y -q --no-install-recommends /debs/foretrack_*.deb /debs/foretrack-station_*.deb'
inside foretrack --version
inside foretrack fly --scenario open_field --for 3
[ -e "$root/usr/share/foretrack/page/index.html" ] || fail "no page"

say "A vehicle's file and keys, as docs/install.md has it"
inside foretrack security init /root/keys
inside foretrack security issue /root/keys --vehicle uav1
mkdir -p "$root/etc/foretrack/keys/uav1"
cp -r "$root"/root/keys/enclaves/uav1/{gate,vehicle} "$root/etc/foretrack/keys/uav1"
{ cat "$root/usr/share/foretrack/vehicle.yaml"; echo "security: /etc/foretrack/keys/uav1"; } >"$root/etc/foretrack/uav1.yaml"
inside foretrack check /etc/foretrack/uav1.yaml
echo "domian: 7" >"$root/etc/foretrack/uav2.yaml"
! inside foretrack check /etc/foretrack/uav2.yaml || fail "a wrong key passed"
rm "$root/etc/foretrack/uav2.yaml"

say "The units' commands, as nobody"
for command in safety_gate stages; do
  grep -q "ExecStart=/usr/bin/env foretrack $command " "$root"/usr/lib/systemd/system/foretrack-*@.service || fail "no unit of $command"
  status=0
  timeout 4 chroot --userspec=nobody "$root" env -i PATH=/usr/bin STATE_DIRECTORY=/tmp/state-$command \
    foretrack "$command" --vehicle uav1 --config /usr/share/foretrack/vehicle.yaml --domain 79 || status=$?
  [ "$status" = 124 ] || [ "$status" = 0 ] || fail "$command ended with $status"
done

say "The pose networks, out of a folder"
if [ -d "$packages/../../models" ] && ls "$packages"/../../models/*.tflite >/dev/null 2>&1; then
  rm -rf "$root/models" && cp -r "$packages/../../models" "$root/models"
  inside foretrack-fetch-models /models
  inside foretrack doctor --help >/dev/null
else
  echo "skipped: they are not in models/"
fi

say "Upgrade"
for deb in "$root"/debs/foretrack_*.deb "$root"/debs/foretrack-station_*.deb; do
  next=$(mktemp -d)
  dpkg-deb -R "$deb" "$next"
  sed -i 's/^Version: .*/&+next/' "$next/DEBIAN/control"
  dpkg-deb --root-owner-group -b "$next" "${deb%.deb}-next.deb" >/dev/null
  rm -rf "$next"
done
inside sh -c 'apt-get install -y -q --no-install-recommends /debs/*-next.deb'
inside foretrack --version
[ -e "$root/etc/foretrack/uav1.yaml" ] || fail "an upgrade took the vehicle's file"

say "Remove and purge"
inside apt-get remove -y -q foretrack-station foretrack
[ ! -e "$root/usr/bin/foretrack" ] || fail "removed, and still there"
[ -e "$root/etc/foretrack/uav1.yaml" ] || fail "removing took the vehicle's file"
inside apt-get purge -y -q foretrack-station foretrack
[ -e "$root/etc/foretrack/keys/uav1/gate/key.pem" ] || fail "purging took the user's keys"
rm -r "$root/etc/foretrack"
left=$(find "$root/usr" "$root/etc" "$root/var/lib" -path "$root/var/lib/dpkg" -prune -o -name '*foretrack*' -print)
[ -z "$left" ] || fail "left behind: $left"
say "All of it works."
