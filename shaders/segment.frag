#version 330 core
in vec2 place;
flat in float line_length;
flat in vec2 look;

out vec4 colour;

void main() {
  float distance = length(vec2(place.x - clamp(place.x, 0.0, line_length), place.y));
  float coverage = clamp(look.x - distance + 0.5, 0.0, 1.0);
  colour = vec4(vec3(1.0 - look.y), coverage);
}
