#version 330 core
in vec3 look;

uniform sampler2D atlas;

out vec4 colour;

void main() {
  float coverage = look.x < 0.0 ? 1.0 : texture(atlas, look.xy).r;
  colour = vec4(vec3(1.0 - look.z), coverage);
}
