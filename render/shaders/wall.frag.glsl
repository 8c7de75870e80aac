// A facade: stories and bays by its style (render/buildings/facade_style.h), windows that stand back in
// their reveals, a plinth. STORIES, SHOPS, GLASS or PLAIN: those walls; else the rare ones
// (wall_words() of render/passes/scenery_pass.cpp).
in vec3 world;
in vec3 ambient;
in vec4 local;  // along the wall, up, wall length, wall height; m
flat in vec3 normal;
flat in uint id;
flat in float facade_kind;  // number of the world::Facade, or of a WallLook
flat in vec4 paint;         // albedo, then the front's number and whether it has shops

layout(location = 0) out vec4 color;
layout(location = 1) out uint instance;

struct Surface {
  vec3 albedo;
  vec3 shine;    // how much of it is glass, by color
  vec3 glow;     // own light, after sunset
  float mirror;  // share of the light that the glass mirrors at a right angle
  float tilt;    // by which a pane leans
  float sun;     // share of the direct sun that reaches it past what is before it on the wall
};

Surface dull() { return Surface(vec3(0.0), vec3(0.0), vec3(0.0), 0.1, 0.0, 1.0); }

#ifdef LAMPS
const float kWindow = 3.0e-4;  // light of a window, in units of lamp light
#endif

vec3 render_color(float pick) {
  const vec3 kPlaster[5] = vec3[](vec3(0.56, 0.50, 0.40), vec3(0.60, 0.57, 0.51),
                                  vec3(0.52, 0.40, 0.29), vec3(0.45, 0.45, 0.43),
                                  vec3(0.58, 0.47, 0.36));
  return kPlaster[int(pick * 4.999)];
}

vec3 brick_color(vec2 p, vec2 width) {
  const vec2 kBrick = vec2(0.25, 0.08);
  float row = floor(p.y / kBrick.y);
  vec2 brick = vec2(p.x / kBrick.x + 0.5 * mod(row, 2.0), p.y / kBrick.y);
  vec2 brick_width = width / kBrick;
  float mortar = max(stripes(brick.x, 0.05, brick_width.x), stripes(brick.y, 0.15, brick_width.y));
  float fade = clamp(1.5 - 1.5 * max(brick_width.x, brick_width.y), 0.0, 1.0);
  float tone = (hash(ivec2(floor(brick))) - 0.5) * fade;
  return mix(paint.rgb * (1.0 + 0.5 * tone), vec3(0.40, 0.38, 0.34), 0.85 * mortar);
}

// Goods on the shelves behind a shop's window, by shop; empty above the highest shelf.
vec3 shop_display(ivec2 cell, vec2 p, vec2 width) {
  const float kShelfM = 0.46;
  float fade = clamp(1.4 - 5.0 * max(width.x, width.y), 0.0, 1.0);
  vec2 at = vec2(p.x / (0.1 + 0.16 * hash(cell + 401 + int(floor(p.y / kShelfM)))), p.y / kShelfM);
  ivec2 item = ivec2(floor(at)) + 31 * cell;
  float kind = hash(item);
  vec2 in_item = fract(at);
  float goods = step(in_item.y, 0.45 + 0.4 * hash(item + 7)) * step(0.12, in_item.x) * step(0.18, kind);
  vec3 paint = mix(vec3(0.04 + 0.2 * fract(kind * 5.1)), vec3(0.24, 0.15, 0.08) * fract(kind * 9.7), 0.6);
  paint = mix(paint, vec3(0.2, 0.04, 0.03), step(0.93, fract(kind * 23.0)));
  float board = band(in_item.y, 0.92, 1.0, width.y / kShelfM);
  vec3 shelves = mix(vec3(0.045, 0.04, 0.035), mix(vec3(0.11), paint, fade), mix(0.5, goods, fade));
  return mix(shelves, vec3(0.13, 0.12, 0.10), board) * step(p.y, 1.75);
}

const float kRevealM = 0.16;  // by which panes stand back

// The way along the wall and up that a ray makes, in a direction away from it, per meter of depth.
vec2 slope_in(vec3 outward) {
  vec3 along = vec3(-normal.y, normal.x, 0.0);
  return vec2(-dot(outward, along), -outward.z) / max(dot(outward, normal), 0.2);
}

// The inside of a shop: shelves, a dim room with lamps and tables, or figures before a bright wall.
vec3 shop_inside(ivec2 cell, vec2 p, vec2 width) {
  // Goods stand further back than panes, and hide each other as one passes.
  vec2 goods = p + 0.7 * slope_in(normalize(light.eye.xyz - world));
  goods.y = max(goods.y, 0.02);
  float trade = hash(cell / ivec2(2, 1) + 409);
  float lamp = smoothstep(0.25, 0.0, length(vec2(fract(goods.x * 0.8) - 0.5, goods.y - 1.9)));
  float table = band(fract(goods.x * 0.55), 0.2, 0.8, width.x) * band(goods.y, 0.62, 0.72, width.y);
  vec3 dim = vec3(0.035, 0.028, 0.022) + vec3(0.30, 0.22, 0.11) * lamp + vec3(0.12, 0.07, 0.04) * table;
  vec2 from_figure = vec2(fract(goods.x * 1.1) - 0.5, 0.55 * (goods.y - 0.85));
  float figure = smoothstep(0.26, 0.2, length(from_figure / vec2(0.7, 1.0)));
  vec3 dress = vec3(0.3) * vec3(fract(trade * 91.0), fract(trade * 57.0), fract(trade * 33.0));
  vec3 bright = mix(vec3(0.20, 0.19, 0.175), dress, figure);
  return trade < 0.45 ? shop_display(cell, goods, width) : trade < 0.7 ? dim : bright;
}

struct Window {
  vec2 half_size;  // m; the height is twice the second
  vec2 panes;      // across and up
  float frame;     // albedo of its frames
  float surround;  // m, of stone around it
  float arch;      // m, by which its head rises in the middle
  bool is_shop;
};

// How much of a footprint lies in a window's opening.
float opening_at(Window w, vec2 p, vec2 width) {
  float head = 2.0 * w.half_size.y - w.arch * pow(abs(p.x) / w.half_size.x, 2.0);
  return band(p.x, -w.half_size.x, w.half_size.x, width.x) * band(p.y, 0.0, head, width.y);
}

// A window; `cell` names it, `p` is relative to its middle bottom.
void add_window(inout Surface s, Window w, ivec2 cell, vec2 p, vec2 width) {
  float tall = 2.0 * w.half_size.y;
  float opening = opening_at(w, p, width);
  Window around = w;
  around.half_size += vec2(w.surround, 0.5 * w.surround);
  float stone = w.surround > 0.0 ? opening_at(around, p, width) : 0.0;
  s.albedo = mix(s.albedo, vec3(0.52, 0.50, 0.46), stone);
  // Panes are seen, and lit, through the opening before them.
  vec2 back = p + kRevealM * slope_in(normalize(light.eye.xyz - world));
  float seen = opening * opening_at(w, back, width);
  float lit = opening_at(w, back - kRevealM * slope_in(light.sun_direction.xyz), width);
  vec2 panes = vec2(w.panes.x * (0.5 + 0.5 * back.x / w.half_size.x), w.panes.y * back.y / tall);
  vec2 bar = vec2(0.055, 0.055) * w.panes / vec2(2.0 * w.half_size.x, tall);
  vec2 bars = vec2(stripes(panes.x + 0.5 * bar.x, bar.x, width.x * w.panes.x / (2.0 * w.half_size.x)),
                   stripes(panes.y + 0.5 * bar.y, bar.y, width.y * w.panes.y / tall));
  float pane = seen * (1.0 - max(bars.x, bars.y));
  float pick = hash(cell);
  float curtain = step(0.55, pick) * band(back.y, tall * (1.1 - pick), 9.0, width.y);
  vec3 inside = mix(vec3(0.025, 0.03, 0.035), vec3(0.30, 0.28, 0.25) * pick, 0.8 * curtain);
  // Some panes show the room: a light ceiling, and what stands on the floor.
  float up = clamp(back.y / tall, 0.0, 1.0);
  float room = step(hash(cell + 307), 0.4) * (1.0 - curtain);
  inside += room * vec3(0.10, 0.085, 0.065) * (smoothstep(0.55, 1.0, up) + 0.5 * step(back.x, 0.0) * (1.0 - up));
#ifdef SHOPS
  if (w.is_shop) inside = shop_inside(cell, p, width);
#endif
  vec3 frame = vec3(w.frame) * (w.frame > 0.3 ? vec3(1.0, 0.98, 0.94) : vec3(1.0));
  s.albedo = mix(s.albedo, 0.75 * s.albedo, opening);
  s.albedo = mix(s.albedo, frame, seen);
  s.albedo = mix(s.albedo, inside, pane);
  s.sun = mix(s.sun, lit, seen);
#ifdef LAMPS
  // Somebody is at home behind every third pane, behind more of them than not in warm light.
  float home = hash(cell + 211);
  vec3 warm = mix(vec3(1.0, 0.72, 0.42), vec3(0.85, 0.92, 1.0), step(0.8, fract(home * 17.0)));
  float burns = step(home, w.is_shop ? 0.6 : 0.36) * (0.35 + 1.6 * min(home, 0.36)) * (1.0 - 0.6 * curtain);
  // Ceilings are bright, and furniture is before the lower parts.
  burns *= mix(0.35, 1.35, up);
  vec3 lit_room = w.is_shop ? 0.3 + 6.0 * inside : vec3(1.0);
  s.glow += warm * lit_room * (pane * burns);
#endif
  s.shine += vec3(pane * mix(0.5, 1.0, lit));  // double glazing
  s.tilt = 0.08 * (hash(cell + 101) - 0.5);
  float sill = band(p.x, -w.half_size.x - 0.1, w.half_size.x + 0.1, width.x) * band(p.y, -0.1, 0.0, width.y);
  s.albedo = mix(s.albedo, vec3(0.55, 0.53, 0.49), sill);
  // Water that runs off the sill stains the wall below, most at its ends.
  float below = band(p.x, -w.half_size.x - 0.1, w.half_size.x + 0.1, width.x) * smoothstep(-1.3, -0.1, p.y) *
                step(p.y, -0.1);
  float at_ends = smoothstep(0.35, 0.0, abs(abs(p.x) - w.half_size.x));
  s.albedo *= 1.0 - below * (0.12 + 0.22 * at_ends) * (0.4 + 0.9 * noise(vec2(p.x * 6.0, float(cell.x))));
}

// A curtain wall: panes 1.4 m wide between slim mullions, a spandrel at every floor.
Surface glass_facade(vec2 p, vec2 size, vec2 width, ivec2 key) {
  vec2 pane_size = vec2(size.x / max(1.0, round(size.x / 1.4)),
                        size.y / max(1.0, round(size.y / 3.5)));
  vec2 at = p / pane_size;
  ivec2 cell = ivec2(floor(at)) + 13 * key;
  vec2 frame = stripes_xy(at + 0.5 * vec2(0.05, 0.0), 0.05, width / pane_size);
  float spandrel = stripes(at.y, 0.22, width.y / pane_size.y);
  Surface s = dull();
  float tone = hash(cell);
  s.albedo = mix(vec3(0.03, 0.04, 0.045) * (0.7 + 0.6 * tone), vec3(0.10, 0.12, 0.13), spandrel);
  // Blinds, each let down in its own way, and rooms with light ceilings.
  float up = fract(at.y);
  float drawn = hash(cell + 53);
  float blind = step(drawn, 0.24) * step(1.0 - 3.0 * drawn, up) * (1.0 - spandrel);
  s.albedo = mix(s.albedo, vec3(0.20, 0.197, 0.18) * (0.8 + 0.4 * tone), 0.75 * blind);
  s.albedo += step(0.7, drawn) * vec3(0.075, 0.07, 0.055) * smoothstep(0.5, 1.0, up) * (1.0 - spandrel);
  s.shine = vec3(0.85, 0.97, 1.0);
  s.mirror = 0.30;
  s.tilt = 0.03 * (hash(cell + 101) - 0.5);
  float metal = max(frame.x, band(p.y, size.y - 0.5, size.y, width.y));
  s.albedo = mix(s.albedo, vec3(0.30, 0.31, 0.32), metal);
  s.shine *= 1.0 - metal;
#ifdef LAMPS
  // Rows of lamps on the ceilings, desks below.
  float lit = step(tone, 0.4) * (0.3 + tone) * (1.0 - metal) * (1.0 - spandrel) * (1.0 - 0.5 * blind);
  float lamps = smoothstep(0.72, 0.8, up) * step(0.3, fract(at.x)) * step(fract(at.x), 0.7);
  s.glow = vec3(0.95, 0.92, 0.8) * (lit * (0.25 + 0.75 * up + 0.7 * lamps));
#endif
  return s;
}

// The houses across the street as panes mirror them: fronts 20 m away with windows, each of its own
// height and color; `along` and `z` say where on them.
vec3 opposite_house(vec2 along_z, float block, vec3 sky) {
  vec3 across_sun = light.sun.rgb * max(-dot(normal, light.sun_direction.xyz), 0.0);
  vec3 paint = render_color(fract(block * 3.7));
  vec2 at = fract(along_z / vec2(2.9, 3.2));
  float window = step(0.28, at.x) * step(at.x, 0.72) * step(0.25, at.y) * step(at.y, 0.78);
  return mix(paint, 0.35 * sky, window) * (across_sun + 0.5 * light.sky.rgb + 0.4 * light.bounce.rgb);
}

// The light that a pane mirrors: the sky with its gradient, and the street and the houses across it. `plain`
// is the share of light that it mirrors at a right angle; more at grazing angles (Fresnel's law in
// Schlick's form, 1994).
vec3 mirrored_in_glass(float plain, float tilt) {
  vec3 to_eye = normalize(light.eye.xyz - world);
  vec3 d = reflect(-to_eye, normal);
  // No two panes stand quite alike.
  d = normalize(d + tilt * vec3(-normal.y, normal.x, 0.6));
  vec3 sky = mix(light.haze.rgb, light.zenith.rgb, sqrt(max(d.z, 0.0)));
  const float kAcrossM = 20.0;
  vec3 there = world + d * (kAcrossM / max(dot(d, normal), 0.05));
  float along = there.x * -normal.y + there.y * normal.x;
  float block = hash(ivec2(int(floor(along / 13.0)), int(floor(dot(world, normal) / 30.0))));
  vec3 seen = there.z < 7.0 + 9.0 * block ? opposite_house(vec2(along, there.z), block, sky) : sky;
  seen = there.z < 0.0 ? 0.8 * light.bounce.rgb : seen;
  return seen * (plain + (1.0 - plain) * pow(1.0 - max(dot(to_eye, normal), 0.0), 5.0));
}

// A door in the middle bay of the ground floor; `p` is relative to its middle bottom.
void add_door(inout Surface s, ivec2 key, vec2 p, vec2 width) {
  const vec3 kDoors[4] = vec3[](vec3(0.10, 0.055, 0.03), vec3(0.03, 0.06, 0.045),
                                vec3(0.035, 0.045, 0.08), vec3(0.12, 0.12, 0.12));
  float leaf = band(abs(p.x), 0.02, 0.62, width.x) * band(p.y, 0.0, 2.15, width.y);
  float surround = band(abs(p.x), -1.0, 0.78, width.x) * band(p.y, -1.0, 2.35, width.y);
  float panel = band(abs(p.x), 0.12, 0.5, width.x) * band(p.y, 1.1, 1.95, width.y);
  vec3 door = kDoors[int(hash(key + 57) * 3.999)];
  s.albedo = mix(s.albedo, vec3(0.50, 0.48, 0.44), surround);
  s.albedo = mix(s.albedo, door, leaf);
  s.shine = mix(s.shine, vec3(0.0), surround) + vec3(0.8 * panel);
  s.glow *= 1.0 - surround;
}

// The doorway of an exit (render/buildings/exit_doors.h): a stone frame, a lit sign above, and either a dark
// passage between opened leaves or closed ones, each about 1 m wide.
Surface exit_door(vec2 p, vec2 size, vec2 width, bool open) {
  float inside = band(p.x, 0.14, size.x - 0.14, width.x) * band(p.y, -1.0, size.y - 0.34, width.y);
  float middle = abs(p.x - 0.5 * size.x);
  float sign_board = band(middle, -1.0, 0.32, width.x) *
                     band(p.y, size.y - 0.29, size.y - 0.06, width.y);
  float leaves = max(1.0, round(size.x - 0.28));
  float leaf = (p.x - 0.14) * leaves / (size.x - 0.28);
  float edge = stripes(leaf + 0.03, 0.06, width.x * leaves / size.x);
  float pane = (1.0 - stripes(leaf + 0.14, 0.28, width.x * leaves / size.x)) *
               band(p.y, 0.9, size.y - 0.5, width.y);
  Surface s = dull();
  s.albedo = vec3(0.46, 0.44, 0.40);
  // Light reaches a short distance in along the floor.
  vec3 passage = mix(vec3(0.10, 0.095, 0.085), vec3(0.018), clamp(p.y / 1.3, 0.0, 1.0));
  vec3 closed = mix(vec3(0.10, 0.11, 0.12) * (1.0 - 0.6 * edge), vec3(0.03), pane);
  float jamb = 1.0 - band(p.x, 0.22, size.x - 0.22, width.x);
  s.albedo = mix(s.albedo, open ? mix(passage, vec3(0.10, 0.11, 0.12), jamb) : closed, inside);
  s.shine += open ? vec3(0.0) : vec3(0.8 * pane * inside);
  s.albedo = mix(s.albedo, open ? vec3(0.03, 0.30, 0.12) : vec3(0.10), sign_board);
#ifdef LAMPS
  float lamp = inside * (0.12 + 0.5 * clamp(0.45 * p.y, 0.0, 1.0));
  if (open) s.glow = vec3(1.0, 0.86, 0.6) * lamp + vec3(0.2, 1.4, 0.5) * sign_board;
#endif
  return s;
}

// Rows of panes between dark bars, above a saw-tooth roof.
Surface glazing(vec2 p, vec2 size, vec2 width) {
  vec2 bars = stripes_xy(p / vec2(1.0, 0.8), 0.08, width / vec2(1.0, 0.8));
  float bar = max(bars.x, bars.y);
  Surface s = dull();
  s.albedo = mix(vec3(0.05, 0.06, 0.065), vec3(0.10), bar);
  s.shine = vec3(1.0 - bar);
  return s;
}

// A wall too low for a story: brick or plaster under a coping.
Surface low_wall(vec2 p, vec2 size, vec2 width, ivec2 key, bool brick) {
  float stain = noise(p * vec2(0.7, 0.9)) - 0.5;
  float splash = exp(-3.0 * p.y) * (0.5 + 0.5 * noise(p * 3.0));
  float coping = band(p.y, size.y - 0.12, size.y, width.y);
  float post = stripes(p.x / 3.0 + 0.03, 0.06, width.x / 3.0);
  Surface s = dull();
  s.albedo = brick ? brick_color(p, width) : render_color(hash(key + 31)) * (1.0 - 0.25 * post);
  s.albedo *= (1.0 + 0.2 * stain) * (1.0 - 0.4 * splash);
  s.albedo = mix(s.albedo, vec3(0.48, 0.46, 0.42), coping);
  return s;
}

// A clipped hedge: tufts of leaves, darker toward the ground.
Surface hedge(vec2 p, vec2 size, vec2 width) {
  float fade = clamp(1.5 - 6.0 * max(width.x, width.y), 0.0, 1.0);
  float tufts = noise(p * 3.1) + 0.7 * (noise(p * 9.7) - 0.5) * fade;
  Surface s = dull();
  s.albedo = vec3(0.019, 0.034, 0.010) * (0.55 + 0.9 * tufts) * (0.6 + 0.4 * p.y / size.y);
  return s;
}

// A wall of lights in a black frame, which shows moving images.
Surface screen(vec2 p, vec2 size, vec2 width) {
  vec2 place = floor(p / 0.25) * 0.25;
  float time_s = light.eye.w;
  vec3 shown = screen_image(place / size.y, time_s);
  float lit = band(p.x, 0.3, size.x - 0.3, width.x) * band(p.y, 1.2, size.y - 0.3, width.y);
  Surface s = dull();
  s.albedo = mix(vec3(0.02), 0.3 * shown, lit);
  s.shine = vec3(0.3 * lit);
  s.mirror = 0.04;
  s.glow = 2.6 * shown * lit;
  return s;
}

// Plaster or brick with its stains; `p` in m.
vec3 wall_albedo(vec2 p, vec2 width, bool brick) {
  float fine = clamp(1.5 - 8.0 * max(width.x, width.y), 0.0, 1.0);
  float stain = noise(p * vec2(0.7, 0.25)) - 0.5;
  // Water runs down below ledges and leaves streaks; the street splashes the foot.
  float streak = noise(vec2(p.x * 5.0, p.y * 0.35 + 17.0)) * noise(vec2(p.x * 1.1 + 5.0, 3.0));
  float splash = exp(-1.6 * p.y) * (0.5 + 0.5 * noise(p * 3.0));
  float rough = (noise(p * 16.0) - 0.5) * fine;
  vec3 albedo = brick ? brick_color(p, width) : paint.rgb;
  return albedo * (1.0 + 0.2 * stain + 0.1 * rough) * (1.0 - 0.45 * streak) * (1.0 - 0.4 * splash);
}

// Paint that somebody sprayed on the foot of a wall: a few letters of thick lines in two colors.
void add_graffiti(inout Surface s, ivec2 key, vec2 p, vec2 size, vec2 width) {
  float from = 0.8 + hash(key + 91) * max(0.0, size.x - 4.5);
  vec2 in_box = (p - vec2(from, 0.5)) / vec2(2.6, 1.1);
  bool is_there = hash(key + 93) < 0.35 && min(in_box.x, in_box.y) > 0.0 && max(in_box.x, in_box.y) < 1.0;
  if (is_there) {
    float letter = floor(in_box.x * 5.0);
    vec2 q = vec2(fract(in_box.x * 5.0), in_box.y) - 0.5;
    float bend = 3.0 * hash(key + ivec2(int(letter), 7));
    float line = abs(length(q * vec2(0.9, 0.75) + 0.12 * sin(bend + 5.0 * q.yx)) - 0.30);
    float fill = smoothstep(0.14, 0.10, line + 0.3 * max(width.x, width.y));
    float rim = smoothstep(0.20, 0.15, line) - fill;
    vec3 tint = 0.45 * vec3(hash(key + 95), hash(key + 96), hash(key + 97));
    s.albedo = mix(s.albedo, tint, 0.85 * fill);
    s.albedo = mix(s.albedo, vec3(0.03), 0.8 * rim);
  }
}

// A gable with the windows of its attic, where they have room below the slopes.
Surface gable(vec2 p, vec2 size, ivec2 key, vec2 width, bool brick) {
  Surface s = dull();
  s.albedo = wall_albedo(p + vec2(0.0, 3.0), width, brick);
  float room = 0.5 * size.x * (1.0 - 2.3 / size.y);
  float apart = room > 2.2 ? 1.25 : 0.0;
  float middle = 0.5 * size.x + apart * sign(p.x - 0.5 * size.x);
  Window attic = Window(vec2(0.45, 0.65), vec2(2.0, 1.0), 0.5, 0.08, 0.0, false);
  if (room > 0.9) add_window(s, attic, key + ivec2(int(middle), 5), p - vec2(middle, 0.7), width);
  return s;
}

// Stories and bays of windows.
Surface stories(vec2 p, vec2 size, ivec2 key, vec2 width, int kind, bool has_shops) {
  vec4 trims = kFacadeTrims[kind];
  vec4 sizes = kFacadeSizes[kind];
  vec4 windows = kFacadeWindows[kind];
  bool brick = trims.z > 0.5;
  vec2 count = max(vec2(1.0), floor(size / sizes.xy + 0.5));
  vec2 bay = size / count;
  ivec2 cell = ivec2(min(floor(p / bay), count - 1.0));
  vec2 within = p - (vec2(cell) + vec2(0.5, 0.0)) * bay;
  bool ground_floor = cell.y == 0;
  bool shop = ground_floor && has_shops && count.y > 1.5;

  Surface s = dull();
  s.albedo = wall_albedo(p, width, brick && !shop);
  if (shop) s.albedo = mix(s.albedo, vec3(0.42, 0.40, 0.37), brick ? 0.0 : 0.35);
  // Joints between slabs, each cast a little differently.
  vec2 joints = stripes_xy(p / bay + 0.004, 0.012, width / bay);
  float tone = hash(cell + 29 * key) - 0.5;
  s.albedo *= 1.0 + trims.w * (0.10 * tone - 0.55 * max(joints.x, joints.y));
  // Stucco of the ground floor in courses.
  float grooves = stripes(p.y / 0.42, 0.09, width.y / 0.42);
  s.albedo *= 1.0 - (kind == 10 && ground_floor ? 0.3 * grooves : 0.0);

  Window w;
  w.is_shop = shop;
  w.half_size = shop ? vec2(0.43 * bay.x, 0.5 * min(0.62 * bay.y, 2.3))
                     : vec2(min(sizes.z, 0.45 * bay.x), 0.5 * sizes.w * bay.y);
  w.panes = shop ? vec2(2.0, 1.0) : windows.yz;
  w.frame = shop ? 0.07 + 0.4 * step(0.7, hash(key + 211)) : windows.w;
  w.surround = shop ? 0.0 : trims.x;
  w.arch = kind == 13 ? 0.28 : kind == 10 && hash(key + 61) < 0.4 ? 0.16 : 0.0;
  float sill = shop ? 0.35 : windows.x * bay.y;
  add_window(s, w, cell + 13 * key, within - vec2(0.0, sill), width);
  float plinth = band(p.y, -1.0, 0.35, width.y);
  s.albedo = mix(s.albedo, 0.45 * s.albedo + vec3(0.07), plinth);
  s.shine *= 1.0 - plinth;
  bool has_door = ground_floor && count.x >= 3.0 && cell.x == int(0.5 * count.x);
  if (has_door) add_door(s, key, within, width);
  if (ground_floor && !shop) add_graffiti(s, key, p, size, width);
#ifdef LAMPS
  // The lamps of wall_lamps() in render/scenery/lamps.cpp.
  float apart = size.x / max(1.0, floor(size.x / 12.0));
  vec2 from_lamp = vec2((fract(p.x / apart) - 0.5) * apart, p.y - min(4.2, 0.8 * size.y));
  float bulb = size.x < 4.0 ? 0.0 : smoothstep(0.16 + width.y, 0.10, length(from_lamp));
  s.glow += 6.0 * bulb * vec3(1.0, 0.85, 0.6);
#endif
  return s;
}

Surface facade(vec2 p, vec2 size, uint building) {
  vec2 width = fwidth(p);
  int more = int(paint.a * 255.0 + 0.5);
  ivec2 key = ivec2(int(building) + 977 * (more & 127), 3);
  int kind = int(facade_kind + 0.5);
#if defined(STORIES)
  return stories(p, size, key, width, kind, more >= 128);
#elif defined(GLASS)
  return glass_facade(p, size, width, key);
#elif defined(PLAIN)
  if (kind == 8) return hedge(p, size, width);
  if (kind < 15) return low_wall(p, size, width, key, kFacadeTrims[kind].z > 0.5);
  Surface s = dull();
  s.albedo = wall_albedo(p, width, false);
  return s;
#else
  if (kind == 4 || kind == 5) return exit_door(p, size, width, kind == 4);
  if (kind == 9) return screen(p, size, width);
  if (kind == 14) return glazing(p, size, width);
  return gable(p, size, key, width, kind == 7);
#endif
}

void main() {
  Surface s = facade(local.xy, local.zw, id & 0xFFFFu);
  float facing = max(dot(normal, light.sun_direction.xyz), 0.0);
  // Walls stand off their own shadow by more than a texel of the map.
  float sun = facing * s.sun * sunlit(world + 0.12 * normal, 0.02);
  // A shadow falls through glass onto what is behind it, and is not seen on it.
  sun = mix(sun, 0.5 * facing, min(s.shine.g, 1.0));
  vec3 received = light.sun.rgb * sun + ambient;
#ifdef FIRES
  float burned = charred(world, noise(vec2(local.x, local.y * 0.5) * 0.8));
  s.albedo = charcoal(s.albedo, burned);
  s.shine *= 1.0 - burned;
  received += fire_light(world, normal);
#endif
  vec3 glow = vec3(0.0);
#ifdef LAMPS
  glow = s.glow * light.lamps.rgb * kWindow;
#endif
  vec3 radiance = s.albedo * received + glow;
#ifndef PLAIN
  radiance += s.shine * mirrored_in_glass(s.mirror, s.tilt);
#endif
  color = vec4(film(through_air(radiance, world)), 1.0);
  instance = id;
}
