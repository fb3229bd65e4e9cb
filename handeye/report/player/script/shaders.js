// Shaders. Light is computed in linear colours. The lamp's part can be stored separately, so that the shadows on still
// bodies can be computed for each picture.

export const VERSION = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2DShadow;
precision mediump sampler2DArray;
`;

// Puts a body in its place. The body's points are whole numbers on its own grid.
const PLACED = `
layout(location = 0) in vec3 point;
layout(location = 1) in vec4 normal;
uniform vec3 place;
uniform vec4 turn, scale;
uniform mat4 view;
vec3 rotated(vec3 v) { return v + 2. * cross(turn.yzw, cross(turn.yzw, v) + turn.x * v); }
vec3 local() { return scale.xyz + point * scale.w; }
`;

// One triangle that covers the whole picture.
const WHOLE = `
out vec2 at;
void main() { at = 2. * vec2(gl_VertexID & 1, gl_VertexID >> 1); gl_Position = vec4(2. * at - 1., 0, 1); }
`;

// Converts light to screen values. Bright parts are compressed, as on film.
const FILM = `
vec4 film(vec3 light) {
  light *= 1.35;
  return vec4(sqrt(clamp(light * (2.51 * light + .03) / (light * (2.43 * light + .59) + .14), 0., 1.)), 1);
}
`;

export const DEPTH = [
  `${PLACED} void main() { gl_Position = view * vec4(rotated(local()) + place, 1); }`,
  "uniform vec4 ink; out vec4 colour; void main() { colour = ink; }",
];

// Colour, gloss and grain come from the table of materials. The third number of the normal is the row of the table.
const SURFACE = `${PLACED}
uniform highp sampler2D materials;
out vec3 world, facing;
out vec2 grained;
flat out vec4 base;
flat out vec3 gloss;
vec3 unfolded(vec2 e) {
  vec3 v = vec3(e, 1. - abs(e.x) - abs(e.y));
  if (v.z < 0.) v.xy = (1. - abs(v.yx)) * vec2(v.x < 0. ? -1. : 1., v.y < 0. ? -1. : 1.);
  return normalize(v);
}
void main() {
  int row = int(normal.z + .5);
  vec4 sheen = texelFetch(materials, ivec2(1, row), 0), repeats = texelFetch(materials, ivec2(2, row), 0);
  vec3 at = local(), n = unfolded(normal.xy / 127.), steep = abs(n);
  base = texelFetch(materials, ivec2(0, row), 0);
  gloss = sheen.xyz;
  int through = steep.z >= max(steep.x, steep.y) ? 2 : steep.x > steep.y ? 0 : 1;
  int along = int(sheen.w) == through ? (through + 1) % 3 : int(sheen.w);
  grained = vec2(at[along], at[3 - through - along]) * repeats.xy;
  world = rotated(at) + place;
  facing = rotated(n);
  gl_Position = view * vec4(world, 1);
}
`;

// Light: a warm lamp with shadows, and cool light from above and from a window. Metal reflects an imaginary room.
// KEPT: the lamp's part is separate and has no shadows. FINE: light from above also casts shadows, from a different
// direction in each exposure.
const LIT = `${FILM}
in vec3 world, facing;
in vec2 grained;
flat in vec4 base;
flat in vec3 gloss;
layout(location = 0) out vec4 colour;
#ifdef KEPT
layout(location = 1) out vec4 lamplight;
#endif
uniform vec3 eye, lamp, aim;
uniform mat4 lampView;
uniform mediump sampler2DArray grain;
uniform sampler2DShadow shadow;
#ifdef FINE
uniform vec3 dome;
uniform mat4 domeView;
uniform sampler2DShadow domeShadow;
uniform float number;
vec2 scatter() {
  float turn = 6.2832 * fract(52.9829 * fract(dot(gl_FragCoord.xy, vec2(.06711, .00584))) + .618034 * number);
  return vec2(cos(turn), sin(turn));
}
#else
vec2 scatter() { return vec2(0); }
#endif
const vec3 WINDOW = vec3(.25, .86, .44);
float reaches(sampler2DShadow map, mat4 view, vec3 p, float spread) {
  vec4 q = view * vec4(p, 1);
  vec3 r = q.xyz / q.w * .5 + .5;
  if (any(greaterThan(abs(r - .5), vec3(.5)))) return 1.;
  return texture(map, r + vec3(spread * scatter() / vec2(textureSize(map, 0)), 0));
}
vec3 room(vec3 way) {
  vec3 light = mix(vec3(.06, .05, .042), vec3(.44, .46, .5), smoothstep(-.3, .6, way.z));
  return light + vec3(.55, .6, .66) * smoothstep(.7, .95, dot(way, WINDOW));
}
void main() {
  vec3 n = normalize(facing), v = normalize(eye - world), to = lamp - world;
  if (dot(n, v) < 0.) n = -n;
  float away = length(to), metallic = gloss.x, rough = max(gloss.y, .2);
  vec3 l = to / away, own = base.rgb;
  if (gloss.z >= 0.) { float t = texture(grain, vec3(grained, gloss.z)).r; own *= t * t; }
  float square = max(dot(n, l), 0.), strength = 0.;
  if (square > 0.) strength = 10. * smoothstep(.68, .9, dot(-l, aim)) / (away * away);
#ifndef KEPT
  if (strength > 0.) strength *= reaches(shadow, lampView, world + n * .004, 2.);
#endif
  float above = n.z * .5 + .5;
#ifdef FINE
  above = 2. * max(dot(n, dome), 0.);
  if (above > 0.) above *= reaches(domeShadow, domeView, world + n * .006, 0.);
#endif
  vec3 mirrored = reflect(-v, n), h = normalize(l + v);
  float rim = 1. - max(dot(n, v), 0.), a = rough * rough, nh = max(dot(n, h), 0.), lh = max(dot(l, h), .32);
  float lobe = lh * (nh * nh * (a * a - 1.) + 1.), glint = min(a * a / (4. * lobe * lobe * (rough + .5)), 8.);
  rim *= rim * rim * rim;
  vec3 sheen = mix(vec3(.04), own, metallic), dull = own * (1. - .7 * metallic);
  vec3 soft = vec3(.23, .245, .275) * above + vec3(.115, .1, .085) * (.5 - .5 * n.z);
  soft += vec3(.07, .085, .11) * max(dot(n, WINDOW), 0.);
  vec3 mirror = (sheen + (1. - sheen) * rim * (1. - rough)) * room(mirrored);
  mirror *= (.35 + .65 * above) * mix(.45, 1.3, metallic * (1.2 - rough));
  vec3 around = dull * soft + mirror + own * base.a * 3.;
  vec3 key = strength * square * vec3(1., .92, .8) * (dull + sheen * glint);
#ifdef KEPT
  colour = vec4(sqrt(around * .25), 1);
  lamplight = vec4(sqrt(key * .25), 1);
#else
  colour = film(around + key);
#endif
}
`;

export const DRAFT = [SURFACE, LIT];
export const FINE = [SURFACE, `#define FINE\n${LIT}`];
export const KEPT = [SURFACE, `#define KEPT\n${LIT}`];

// The stored picture of the still bodies, with the present shadows, and with depth, which can hide moving bodies.
export const RECALLED = [WHOLE, `${FILM}
in vec2 at;
out vec4 colour;
uniform sampler2D around, lamplight;
uniform highp sampler2D depth;
uniform sampler2DShadow shadow;
uniform mat4 back, lampView;
uniform vec3 lamp;
void main() {
  float z = texture(depth, at).r;
  vec3 soft = texture(around, at).rgb, key = texture(lamplight, at).rgb;
  soft *= soft * 4.;
  key *= key * 4.;
  if (key.g > .002) {
    vec4 p = back * vec4(2. * vec3(at, z) - 1., 1);
    p /= p.w;
    p.xyz += .007 * normalize(lamp - p.xyz);
    vec4 q = lampView * p;
    vec3 r = q.xyz / q.w * .5 + .5;
    if (all(lessThan(abs(r - .5), vec3(.5)))) key *= texture(shadow, r);
  }
  colour = film(soft + key);
  gl_FragDepth = z;
}
`];

export const WEIGHED = [WHOLE, `
in vec2 at;
out vec4 colour;
uniform sampler2D image;
uniform float weight;
void main() { colour = vec4(texture(image, at).rgb * weight, 1); }
`];
