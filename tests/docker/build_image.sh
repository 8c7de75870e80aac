#!/usr/bin/env bash
# Builds docker/Dockerfile without a daemon and without pulling anything: the base image is made by debootstrap as Debian's
# slim one is. Prints how long it took and what each layer takes. Run as root; the image is localhost/throng-test in STORE.
# usage: tests/docker/build_image.sh STORE
set -euo pipefail
# shellcheck source=scripts/lib.sh
. "$(dirname "$0")/../../scripts/lib.sh"
store="$(mkdir -p "$1" && cd "$1" && pwd)"
base=docker.io/library/debian:bookworm-slim
export TMPDIR="$store/tmp" BUILDAH_ISOLATION=chroot STORAGE_DRIVER=overlay
mkdir -p "$TMPDIR"
buildah() { command buildah --root "$store/storage" --runroot "$store/run" "$@"; }

make_base() {
  local system="$store/base" container
  rm -rf "$system"
  debootstrap --variant=minbase --include=ca-certificates bookworm "$system" "$(debian_mirror)" >"$store/debootstrap.log"
  cat >"$system/etc/dpkg/dpkg.cfg.d/docker" <<'END'
path-exclude /usr/share/doc/*
path-include /usr/share/doc/*/copyright
path-exclude /usr/share/man/*
path-exclude /usr/share/locale/*
path-exclude /usr/share/info/*
path-exclude /usr/share/lintian/*
END
  rm -rf "$system"/usr/share/{man,locale,info,lintian}/* "$system"/var/cache/apt/archives/*.deb "$system"/var/lib/apt/lists/*
  find "$system/usr/share/doc" -type f ! -name copyright -delete
  copy_registries "$system"
  container="$(buildah from scratch)"
  buildah add -q "$container" "$system" / >/dev/null
  buildah config --cmd '["bash"]' \
    --env PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin --env npm_config_cafile=/etc/host-certificates.crt "$container"
  buildah commit -q "$container" "$base" >/dev/null
  buildah rm "$container" >/dev/null
  rm -rf "$system"
}

start=$SECONDS
buildah inspect --type image "$base" >/dev/null 2>&1 || make_base
echo "base image: $((SECONDS - start)) s"
start=$SECONDS
# Files that this machine has compiled before are not compiled again: the cache of docker/Dockerfile's build step. Debian 12's
# buildah keeps caches in the first folder, newer ones in the second.
for cache in "$TMPDIR/buildah-cache" "$TMPDIR/buildah-cache-$(id -u)"; do
  mkdir -p "$cache" "${CCACHE_DIR:-$HOME/.cache/ccache}"
  [ -e "$cache/throng-ccache" ] || ln -s "${CCACHE_DIR:-$HOME/.cache/ccache}" "$cache/throng-ccache"
done
git -C "$root" ls-files -z --cached --others --exclude-standard >"$store/files"
rm -rf "$store/context"
mkdir -p "$store/context"
tar -C "$root" --null --files-from="$store/files" --ignore-failed-read -cf - 2>/dev/null | tar -C "$store/context" -xf -
cp "$root/.dockerignore" "$store/context/"
buildah bud --format docker --network host --pull-never --layers \
  -t localhost/throng-test -f "$store/context/docker/Dockerfile" "$store/context"
# The layers of this build and of the one before stay; those of older ones would fill the disk.
buildah images -q --filter dangling=true | tail -n +3 | while read -r old; do buildah rmi "$old" >/dev/null 2>&1 || true; done
echo "image: $((SECONDS - start)) s"
