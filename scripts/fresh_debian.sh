#!/usr/bin/env bash
# Proves the README's two commands on a fresh Debian 12: debootstraps a minimal system into a folder,
# clones this repository's HEAD into it and runs scripts/demo.sh and scripts/test.sh there. Prints how long each
# takes, and the time from clone to first image.
# usage: scripts/fresh_debian.sh [FOLDER] [COMMAND...]     (needs root and debootstrap)
set -euo pipefail
# shellcheck source=scripts/lib.sh
. "$(dirname "$0")/lib.sh"
folder="${1:-/var/tmp/throng-fresh}"
shift || true
[ $# -gt 0 ] || set -- scripts/demo.sh scripts/test.sh
[ "$(id -u)" = 0 ] || { echo "fresh_debian.sh: needs root" >&2; exit 1; }

unmount() {
  for mount in dev/pts dev/shm dev sys proc .; do
    mountpoint -q "$folder/$mount" && umount -l "$folder/$mount"
  done
  return 0
}
trap unmount EXIT
unmount
rm -rf --one-file-system "$folder"

# A mount of its own: mount namespaces, which tests make, cannot begin below a folder that is none.
mkdir -p "$folder"
mount --bind "$folder" "$folder"
mount --make-private "$folder"
debootstrap --variant=minbase bookworm "$folder" "$(debian_mirror)" >"$folder.debootstrap.log"

copy_registries "$folder"
cp -L /etc/resolv.conf /etc/hosts "$folder/etc/"

clone_start=$SECONDS
git clone -q --no-hardlinks "$root" "$folder/throng"
for mount in proc sys dev dev/pts dev/shm; do
  mkdir -p "$folder/$mount"
  mount --bind "/$mount" "$folder/$mount"
done
for command in "$@"; do
  echo "== fresh Debian: $command"
  start=$SECONDS
  env -i HOME=/root TERM=dumb LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin CI="${CI:-}" \
    npm_config_cafile=/etc/host-certificates.crt \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
    chroot "$folder" /bin/bash -c "cd /throng && $command"
  echo "== fresh Debian: $command took $((SECONDS - start)) s"
  if [ "$command" = scripts/demo.sh ]; then
    echo "== fresh Debian: from clone to first image: $((SECONDS - clone_start)) s"
  fi
done
