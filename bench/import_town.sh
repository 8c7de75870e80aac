#!/usr/bin/env bash
# How long a town of OpenStreetMap takes: to import, to check, and to load until its first step is simulated. The map is
# drawn here from a seed: blocks of ten houses (one of ten with parts) between streets, trees, fences and parks.
#   bench/import_town.sh [BUILDINGS=5000] [PEOPLE=1000]
# THRONG names another program than build/release/cli/throng.
set -euo pipefail
root="$(cd "$(dirname "$0")/.." && pwd)"
throng="${THRONG:-$root/build/release/cli/throng}"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

python3 - "$work/town.osm" "${1:-5000}" <<'PY'
import math, random, sys
random.seed(1)
count, out, nodes, ways = int(sys.argv[2]), open(sys.argv[1], "w"), [], []
side = math.ceil(math.sqrt(count / 10))  # blocks along each axis, 90 m x 50 m
degrees = lambda x, y: (48 + y / 111_200, 11 + x / 74_600)

def node(x, y, tags=()):
    nodes.append((len(nodes) + 1, *degrees(x, y), tags))
    return len(nodes)

def way(points, tags, closed=True):
    ids = [p if isinstance(p, int) else node(*p) for p in points]
    ways.append((ids + ids[:1] if closed else ids, tags))

def box(x, y, w, h, tags, turn=0.0):
    c, s = math.cos(turn), math.sin(turn)
    way([(x + c * a - s * b, y + s * a + c * b) for a, b in ((0, 0), (w, 0), (w, h), (0, h))], tags)

houses = 0
for i in range(side):
    for j in range(side):
        x, y = i * 90, j * 50
        for k in range(10):
            if houses == count:
                break
            houses += 1
            bx, by, turn = x + 6 + (k % 5) * 15, y + 6 + (k // 5) * 20, random.uniform(-0.05, 0.05)
            box(bx, by, 10, 12, {"building": "house", "building:levels": random.randint(1, 5)}, turn)
            if k == 0:
                box(bx + 1, by + 1, 4, 4, {"building:part": "yes", "height": 20, "min_height": 6}, turn)
                box(bx, by, 10, 12, {"building:part": "yes", "height": 6}, turn)
        for _ in range(4):
            node(x + random.uniform(5, 80), y + 21, {"natural": "tree"})
        way([(x + 5, y + 22), (x + 70, y + 22)], {"barrier": "fence"}, False)
        if (i * 7 + j) % 13 == 0:
            box(x + 74, y + 4, 6, 40, {"leisure": "park"})
corner = {(i, j): node(i * 90 - 5, j * 50 - 5) for i in range(side + 1) for j in range(side + 1)}
for i in range(side + 1):
    way([corner[i, j] for j in range(side + 1)], {"highway": "residential"}, False)
    way([corner[j, i] for j in range(side + 1)], {"highway": "tertiary"}, False)
xml = lambda tags: "".join(f'<tag k="{k}" v="{v}"/>' for k, v in dict(tags).items())
low, high = degrees(-5, -5), degrees(side * 90 - 5, side * 50 - 5)
out.write(f'<osm version="0.6"><bounds minlat="{low[0]}" minlon="{low[1]}" maxlat="{high[0]}" maxlon="{high[1]}"/>\n')
for i, lat, lon, tags in nodes:
    out.write(f'<node id="{i}" lat="{lat:.7f}" lon="{lon:.7f}">{xml(tags)}</node>\n')
for i, (ids, tags) in enumerate(ways):
    out.write(f'<way id="{i + 1}">' + "".join(f'<nd ref="{n}"/>' for n in ids) + xml(tags) + "</way>\n")
out.write("</osm>\n")
PY

printf '{"scenario": "town", "capture": {"rate_hz": 10, "from_s": 0, "to_s": 0.1}}' > "$work/job.json"
timed() {
  TIMEFORMAT="%R %U"
  local times wall_s cpu_s
  times=$({ time "${@:2}" > "$work/out.txt" 2>&1; } 2>&1) || { cat "$work/out.txt"; exit 1; }
  read -r wall_s cpu_s <<<"$times"
  printf '%-10s %9.2f %9.2f   %s\n' "$1" "$wall_s" "$cpu_s" "$(tail -1 "$work/out.txt" | cut -c1-90)"
}
printf '%-10s %9s %9s\n' step 'wall, s' 'CPU, s'
timed import "$throng" scenario import "$work/town.osm" -o "$work/scenarios" --people "${2:-1000}"
timed check "$throng" scenario check "$work/scenarios"
THRONG_SCENARIOS="$work/scenarios" timed load "$throng" simulate "$work/job.json" -o "$work/trace.h5"
