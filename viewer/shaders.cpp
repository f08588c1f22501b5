#include "viewer/shaders.h"

namespace ramify::shaders {
namespace {

constexpr const char* kDecode = R"(
vec3 linear_of(vec3 encoded) {
  return mix(encoded / 12.92, pow((encoded + 0.055) / 1.055, vec3(2.4)), step(0.04045, encoded));
}
)";

// What a material's image says at a place of the surface.
constexpr const char* kSurface = R"(
in vec2 place;  // on the image
uniform sampler2D image;
uniform bool has_image;
uniform bool is_cutout;

// How much of the pixel the surface covers, from 0 to 1: the image's alpha, its edge as sharp as the pixels
// are. Coarser copies of the image blur thin things away; they get that much more.
float presence() {
  if (!is_cutout) return 1.0;
  vec2 texels = vec2(textureSize(image, 0));
  vec2 dx = dFdx(place) * texels;
  vec2 dy = dFdy(place) * texels;
  float lod = max(0.0, 0.5 * log2(max(dot(dx, dx), dot(dy, dy))));
  float alpha = texture(image, place).a * (1.0 + 0.25 * lod);
  return clamp((alpha - 0.5) / max(fwidth(alpha), 0.05) + 0.5, 0.0, 1.0);
}
)";

// Sunlight and skylight add up to 1 on level ground in the open, so that its colour there is its own.
constexpr const char* kLight = R"(
uniform vec3 to_sun;
uniform sampler3D sky_visibility;
uniform mat4 world_to_sky;
uniform mat4 world_to_map;
uniform vec2 map_size;   // metres across and up the picture that the sun takes
uniform float map_depth; // metres

const vec3 kSunShare = vec3(0.60, 0.575, 0.53);
const vec3 kSkyShare = vec3(0.40, 0.425, 0.47);

float open_sky(vec3 world) {
  vec3 at = (world_to_sky * vec4(world, 1.0)).xyz;
  // Towards the sides of the box the darkening fades out, so that none is seen to end there.
  vec2 inside = smoothstep(0.0, 0.16, at.xz) * smoothstep(0.0, 0.16, 1.0 - at.xz);
  return mix(1.0, texture(sky_visibility, at).r, inside.x * inside.y);
}
)";

}  // namespace

std::string screen_vertex() {
  return R"(
out vec2 place;  // from 0 to 1 over the viewport
void main() {
  place = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
}
)";
}

std::string background_fragment() {
  return R"(
in vec2 place;
uniform vec4 bottom;
uniform vec4 top;
uniform vec2 part;  // heights in the whole picture at which the viewport starts and ends
out vec4 color;
void main() { color = mix(bottom, top, smoothstep(0.25, 1.0, mix(part.x, part.y, place.y))); }
)";
}

std::string finish_fragment() {
  return R"(
uniform sampler2D picture;  // `fineness` times as wide and high as what is written
uniform int fineness;
out vec4 color;

vec3 encoded(vec3 light) {
  light = clamp(light, 0.0, 1.0);
  return mix(light * 12.92, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light));
}

// Ordered thresholds from 0 to 1, an 8 x 8 Bayer matrix: hides the steps of 8 bits in soft gradients.
float threshold(ivec2 at) {
  int value = 0;
  for (int bit = 0; bit < 3; ++bit) {
    int x = (at.x >> bit) & 1;
    int y = (at.y >> bit) & 1;
    value = value * 4 + 2 * (x ^ y) + y;
  }
  return (float(value) + 0.5) / 64.0;
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 sum = vec4(0.0);
  for (int y = 0; y < fineness; ++y) {
    for (int x = 0; x < fineness; ++x) sum += texelFetch(picture, fineness * at + ivec2(x, y), 0);
  }
  sum /= float(fineness * fineness);
  vec3 straight = sum.a > 0.0 ? sum.rgb / sum.a : vec3(0.0);
  // Less than half a step either way: a plain colour stays exactly what it was.
  float dither = 0.8 * (threshold(at) - 0.5) / 255.0;
  color = vec4(encoded(straight) + dither, sum.a);
}
)";
}

std::string caster_vertex() {
  return R"(
layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv;
uniform mat4 world_to_map;
out vec2 place;
out float height;
out float depth;
void main() {
  place = uv;
  vec3 at = (world_to_map * vec4(position, 1.0)).xyz;
  height = position.y;
  depth = at.z;
  gl_Position = vec4(2.0 * at - 1.0, 1.0);
}
)";
}

std::string caster_fragment() {
  return std::string(kSurface) + R"(
in float height;
in float depth;
uniform float ground;
out vec2 shade;
void main() {
  // Roots in the ground cast no shadow on it.
  if (height < ground || presence() < 0.5) discard;
  shade = vec2(1.0, depth);
}
)";
}

std::string flat_vertex() {
  return std::string(kDecode) + R"(
layout(location = 0) in vec3 position;
layout(location = 2) in vec4 color;
layout(location = 3) in vec2 uv;
uniform mat4 world_to_clip;
out vec3 paint;
out vec2 place;
void main() {
  paint = linear_of(color.rgb);
  place = uv;
  gl_Position = world_to_clip * vec4(position, 1.0);
}
)";
}

std::string flat_fragment() {
  return std::string(kSurface) + R"(
in vec3 paint;
out vec4 color;
void main() {
  float present = presence();
  if (present < 0.25) discard;
  color = vec4(paint, present);
}
)";
}

std::string lit_vertex() {
  return std::string(kDecode) + R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(location = 3) in vec2 uv;
uniform mat4 world_to_clip;
out vec2 place;
out vec3 world;
out vec3 world_normal;
out vec3 albedo;
out float opacity;
uniform bool is_overlay;
void main() {
  place = uv;
  world = position;
  world_normal = normal;
  albedo = linear_of(color.rgb);
  opacity = is_overlay ? color.a : 1.0;
  gl_Position = world_to_clip * vec4(position, 1.0);
}
)";
}

std::string lit_fragment() {
  return std::string(kSurface) + kLight + R"(
in vec3 world;
in vec3 world_normal;
in vec3 albedo;
in float opacity;
uniform vec3 surface_color;
uniform bool is_thin;
uniform bool has_normal_map;
uniform sampler2D normal_map;
uniform sampler2DShadow sun_depth;
uniform float texel;  // metres
out vec4 color;

// Four comparisons, each of which the texture unit blends from four.
float sunlit(vec3 normal) {
  // Off the surface along its normal, so that it does not shade itself; further where the sun grazes it.
  float slope = sqrt(max(0.0, 1.0 - pow(dot(normal, to_sun), 2.0)));
  vec3 at = world + normal * texel * (0.8 + 2.4 * slope) + to_sun * texel;
  vec3 map = (world_to_map * vec4(at, 1.0)).xyz;
  vec3 step = vec3(0.6 * texel / map_size, 0.0);
  return 0.25 * (texture(sun_depth, map - step) + texture(sun_depth, map + step) +
                 texture(sun_depth, map + step * vec3(1.0, -1.0, 0.0)) +
                 texture(sun_depth, map + step * vec3(-1.0, 1.0, 0.0)));
}

// The normal map's normal in the frame that the image's axes make with the surface here.
vec3 bumped(vec3 normal) {
  vec3 p = dFdx(world);
  vec3 q = dFdy(world);
  vec2 s = dFdx(place);
  vec2 t = dFdy(place);
  float turn = s.x * t.y - s.y * t.x;
  vec3 along = (p * t.y - q * s.y) * sign(turn);
  along -= normal * dot(along, normal);
  if (dot(along, along) < 1e-24) return normal;
  vec3 u = normalize(along);
  vec3 v = cross(normal, u) * sign(turn);
  vec3 bump = 2.0 * texture(normal_map, place).xyz - 1.0;
  return normalize(u * bump.x + v * bump.y + normal * max(bump.z, 0.1));
}

// Sunlight that falls on the surface; through a thin one it comes from behind, too, and is greener then.
vec3 sunlight(vec3 normal, vec3 shaped) {
  float facing = dot(shaped, to_sun);
  float behind = is_thin ? max(-dot(normal, to_sun), 0.0) : 0.0;
  if (max(facing, behind) <= 0.0) return vec3(0.0);
  float lit = sunlit(behind > 0.0 ? -normal : normal) / to_sun.y;
  return lit * (max(facing, 0.0) + behind * vec3(0.62, 0.66, 0.30));
}

void main() {
  float present = presence();
  if (present < 0.25) discard;
  vec3 normal = normalize(gl_FrontFacing ? world_normal : -world_normal);
  vec3 shaped = has_normal_map ? bumped(normal) : normal;
  vec3 paint = albedo * surface_color;
  if (has_image) paint *= texture(image, place).rgb;
  float sky = open_sky(world);
  sky = mix(0.2, 1.0, sky * sky);
  // The ground throws a little warm light back up; a thin surface shows what comes from both sides.
  float up = is_thin ? 0.35 * shaped.y + 0.2 : shaped.y;
  vec3 ambient = mix(vec3(0.44, 0.40, 0.35), kSkyShare * 1.4, 0.5 + 0.5 * up);
  vec3 sun = 1.45 * kSunShare * sunlight(normal, shaped);
  color = vec4(paint * (sun + ambient * sky), present * opacity);
}
)";
}

std::string ground_vertex() {
  return R"(
uniform mat4 world_to_clip;
uniform vec3 middle;
uniform float reach;
out vec3 world;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  world = middle + reach * vec3(corner.x, 0.0, corner.y);
  gl_Position = world_to_clip * vec4(world, 1.0);
}
)";
}

std::string ground_fragment() {
  return std::string(kLight) + R"(
in vec3 world;
uniform sampler2D shade;  // what the sun sees: coverage, and coverage times depth
uniform vec3 paint;
uniform vec3 middle;
uniform float reach;
uniform float penumbra;  // radius a metre
out vec4 color;

// Part of the sun that the tree hides. The shadow's edge is as soft as what casts it is high: the mean depth
// around tells how far that is, and how coarse a copy of the map to read.
float hidden_sun(vec3 at) {
  vec3 map = (world_to_map * vec4(at, 1.0)).xyz;
  if (any(lessThan(map.xy, vec2(0.0))) || any(greaterThan(map.xy, vec2(1.0)))) return 0.0;
  vec2 metres = map_size / vec2(textureSize(shade, 0));
  float texels = 1.0 / max(metres.x, metres.y);
  float widest = max(penumbra * map_depth * texels, 2.0);
  vec2 around = textureLod(shade, map.xy, log2(widest)).rg;
  if (around.r < 1e-4) return 0.0;
  float distance = max(map.z - around.g / around.r, 0.0) * map_depth;
  float radius = max(penumbra * distance * texels, 1.0);

  float lod = max(log2(radius) - 1.0, 0.0);
  vec2 step = 0.7 * radius / texels / map_size;
  float hidden = 0.0;
  float total = 0.0;
  for (int y = -2; y <= 2; ++y) {
    for (int x = -2; x <= 2; ++x) {
      float weight = exp(-0.35 * float(x * x + y * y));
      hidden += weight * textureLod(shade, map.xy + vec2(x, y) * step, lod).r;
      total += weight;
    }
  }
  return hidden / total;
}

void main() {
  float away = length(world - middle) / reach;
  float presence = 1.0 - smoothstep(0.25, 1.0, away);
  if (presence <= 0.0) discard;
  float sky = open_sky(world);
  vec3 light = kSunShare * (1.0 - hidden_sun(world)) + kSkyShare * sky;
  color = vec4(paint * light, 1.0) * presence;
}
)";
}

std::string line_vertex() {
  return std::string(kDecode) + R"(
layout(location = 0) in vec3 start;
layout(location = 1) in vec3 end;
layout(location = 2) in vec4 color;
uniform mat4 world_to_clip;
uniform vec2 viewport;     // pixels
uniform float half_width;  // pixels
out vec4 paint;
void main() {
  paint = vec4(linear_of(color.rgb), color.a);
  vec4 from = world_to_clip * vec4(start, 1.0);
  vec4 to = world_to_clip * vec4(end, 1.0);
  vec2 along = (to.xy / to.w - from.xy / from.w) * viewport;
  along = length(along) > 1e-4 ? normalize(along) : vec2(1.0, 0.0);
  vec2 side = vec2(-along.y, along.x) * ((gl_VertexID & 1) == 0 ? 1.0 : -1.0);
  bool is_start = gl_VertexID < 2;
  vec4 at = is_start ? from : to;
  // Longer by half its width at both ends, which closes the bends.
  vec2 shift = half_width * (side + (is_start ? -along : along));
  gl_Position = at + vec4(2.0 * shift / viewport * at.w, 0.0, 0.0);
}
)";
}

std::string square_vertex() {
  return std::string(kDecode) + R"(
layout(location = 0) in vec3 middle;
layout(location = 2) in vec4 color;
uniform mat4 world_to_clip;
uniform float side;  // metres
out vec4 paint;
void main() {
  paint = vec4(linear_of(color.rgb), color.a);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) - 0.5;
  gl_Position = world_to_clip * vec4(middle + side * vec3(corner, 0.0), 1.0);
}
)";
}

std::string line_fragment() {
  return R"(
in vec4 paint;
out vec4 color;
void main() { color = vec4(paint.rgb * paint.a, paint.a); }
)";
}

std::string dot_vertex() {
  return std::string(kDecode) + R"(
layout(location = 0) in vec3 middle;
layout(location = 2) in vec4 color;
uniform mat4 world_to_clip;
uniform vec2 viewport;  // pixels
uniform float radius;   // pixels, of a dot where clip space's w is 1
uniform vec2 bounds;    // the least and greatest radius, pixels
out vec4 paint;
out vec2 place;
void main() {
  paint = vec4(linear_of(color.rgb), color.a);
  place = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
  vec4 at = world_to_clip * vec4(middle, 1.0);
  float size = clamp(radius / at.w, bounds.x, bounds.y);
  gl_Position = at + vec4(2.0 * size * place / viewport * at.w, 0.0, 0.0);
}
)";
}

std::string dot_fragment() {
  return R"(
in vec4 paint;
in vec2 place;  // from -1 to 1 over the dot
out vec4 color;
void main() {
  float square = dot(place, place);
  if (square > 1.0) discard;
  // A ball, lit from above on the left.
  vec3 normal = vec3(place, sqrt(1.0 - square));
  float light = 0.55 + 0.6 * max(dot(normal, vec3(-0.37, 0.64, 0.67)), 0.0);
  color = vec4(min(paint.rgb * light, vec3(1.0)) * paint.a, paint.a);
}
)";
}

std::string veil_vertex() {
  return R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float bend;  // 1/m
uniform mat4 world_to_clip;
out vec3 world;
out vec3 world_normal;
out float roundness;
void main() {
  world = position;
  world_normal = normal;
  roundness = bend;
  gl_Position = world_to_clip * vec4(position, 1.0);
}
)";
}

std::string veil_fragment() {
  return R"(
in vec3 world;
in vec3 world_normal;
in float roundness;  // 1/m
uniform vec4 eye;  // with w 0 the direction towards a viewer without perspective
uniform vec3 paint;
uniform vec3 middle;
uniform float reach;  // metres from the middle
out vec4 color;
void main() {
  vec3 to_eye = normalize(eye.xyz - world * eye.w);
  float facing = abs(dot(normalize(world_normal), to_eye));
  // A soap bubble: one looks through more of it where it is seen from the side. Where it is flat that is no
  // edge: a wide face would be a stain over all behind it.
  float bubble = min(0.5 * reach * roundness, 1.0);
  float opacity = 0.07 + 0.43 * bubble * pow(1.0 - facing, 2.5);
  opacity *= 1.0 - smoothstep(0.5, 1.0, distance(world, middle) / reach);
  color = vec4(paint * opacity, opacity);
}
)";
}

}  // namespace ramify::shaders
