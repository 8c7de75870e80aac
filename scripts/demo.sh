#!/usr/bin/env bash
# The main job from nothing: installs, builds, starts a server on a free loopback port, submits
# scenarios/city_square/demo.job.json over HTTP, downloads the archive, draws one frame with all of its labels and makes
# the report of the evacuation. Says how long it takes before it starts, and at the end what to open next.
# usage: scripts/demo.sh [--keep]   --keep: the server stays up until Ctrl-C
set -euo pipefail
keep=
case "${1:-}" in
  "") ;;
  --keep) keep=1 ;;
  *) echo "unknown argument $1; usage: scripts/demo.sh [--keep]" >&2; exit 2 ;;
esac
# shellcheck source=scripts/lib.sh
. "$(dirname "$0")/lib.sh"
if [ -x "$built_throng" ]; then
  say "throng is built: about a minute for the job, more if sources have changed"
else
  say "about 9 minutes on two cores to the first image: 2 for the packages, 6 to compile, one for characters and the job; then 4 for the rest"
  echo "needs root or sudo, 5 GB of disk and 510 MB to download (1,040 Debian packages)"
fi
# The rest is compiled after the first image.
throng="$built_throng"
if [ -s "$people/population.json" ]; then
  "$root/scripts/setup.sh"
else
  "$root/scripts/setup.sh" --first
  throng="$first_throng"
fi

out="$root/build/demo"
job_file="$root/scenarios/city_square/demo.job.json"
rm -rf "$out"
mkdir -p "$out/data"

# start_server PORT: sets server and url; 0 is a free port.
start_server() {
  rm -f "$out/port"
  "$throng" serve --data "$out/data" --port "$1" --port-file "$out/port" >>"$out/server.log" 2>&1 &
  server=$!
  for _ in $(seq 100); do
    [ -s "$out/port" ] && break
    kill -0 "$server" 2>/dev/null || { cat "$out/server.log"; exit 1; }
    sleep 0.1
  done
  url="http://127.0.0.1:$(cat "$out/port")"
  echo "listening on $url"
}
stop_server() {
  kill "$server" 2>/dev/null
  wait "$server" 2>/dev/null || true
}

say "starting the server"
trap stop_server EXIT
start_server 0

say "submitting $(basename "$job_file")"
job="$(curl -fsS -H 'Content-Type: application/json' --data-binary "@$job_file" "$url/v1/jobs" | jq -r .id)"
echo "job $job"
while :; do
  answer="$(curl -fsS "$url/v1/jobs/$job")"
  state="$(jq -r .state <<<"$answer")"
  jq -r '"\(.state): \(.progress.frames_done // 0) of \(.progress.frames_total // "?") frames \(.progress.stage // "")"' <<<"$answer"
  case "$state" in
    succeeded) break ;;
    failed | cancelled) jq . <<<"$answer"; exit 1 ;;
  esac
  sleep 1
done

say "downloading the archive"
curl -fsS -o "$out/archive.tar" "$url/v1/jobs/$job/archive"
echo "$(stat -c %s "$out/archive.tar") bytes"
mkdir "$out/dataset"
tar -xf "$out/archive.tar" -C "$out/dataset" --strip-components=1
/usr/bin/python3 "$root/scripts/show_dataset.py" "$out/dataset"

say "drawing a frame with its labels, and the report"
"$root/scripts/sheets/labels_sheet.py" "$out/dataset" "$out/labels.jpg"
THRONG_URL="$url" "$throng" report "$job" -o "$out/report.html"
say "the first image, $out/labels.jpg: after $SECONDS s"

say "compiling the rest: calibration, live flights, checks, imports, the engine for Python; more characters (scripts/setup.sh goes on after Ctrl-C)"
"$root/scripts/setup.sh"

if [ -n "$keep" ]; then
  if [ "$throng" != "$built_throng" ]; then
    stop_server
    throng="$built_throng"
    start_server "${url##*:}"
  fi
  page="$url/jobs/$job   (Ctrl-C ends the server)"
else
  page="http://127.0.0.1:8080/jobs/$job   after: build/release/cli/throng serve --data build/demo/data"
fi
say "done after $SECONDS s; open next:"
cat <<END
a frame and its labels:  $out/labels.jpg
the dataset:             $out/dataset   (README.md in it says what is where)
the evacuation's report: $out/report.html
Studio, the web page:    $page
a job of your own:       export PATH=$root/build/release/cli:\$PATH; throng run scenarios/bridge/demo.job.json -o out
documentation:           $root/docs/README.md
END
if [ -n "$keep" ]; then wait "$server"; fi
