#version 330 core
in vec2 place;
in vec4 ink;

uniform sampler2D atlas;

out vec4 colour;

void main() {
  float coverage = place.x < 0.0 ? 1.0 : texture(atlas, place).r;
  colour = ink * coverage;
}
