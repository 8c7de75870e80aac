#!/usr/bin/env bash
# Proves the README's two commands on a fresh Debian 12: debootstraps a minimal system into a folder,
# clones this repository's HEAD into it and runs scripts/demo.sh and scripts/test.sh there. Prints how long each
# takes, and the time from clone to first image: it fails if README's is off by more than a fifth.
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

# compare_with_readme CLONE_S: the demo's time to the first image, after a clone that took CLONE_S, and README's minutes.
compare_with_readme() {
  local first_s readme_min
  first_s=$(($1 + $(sed -n 's/.*the first image, .*: after \([0-9]*\) s.*/\1/p' "$folder.log")))
  readme_min="$(sed -n 's/^The demo takes \([0-9]*\) minutes .* from the clone to the first image.*/\1/p' "$root/README.md")"
  echo "== fresh Debian: from clone to first image: $first_s s; README says $readme_min minutes"
  if [ $((first_s * 5)) -gt $((readme_min * 60 * 6)) ] || [ $((first_s * 5)) -lt $((readme_min * 60 * 4)) ]; then
    echo "fresh_debian.sh: README.md and scripts/demo.sh must say what was measured" >&2
    return 1
  fi
}

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
    chroot "$folder" /bin/bash -c "cd /throng && $command" | tee "$folder.log"
  echo "== fresh Debian: $command took $((SECONDS - start)) s"
  if [ "$command" = scripts/demo.sh ]; then compare_with_readme $((start - clone_start)); fi
done
