#version 330 core
in vec2 place;
in vec4 ink;

uniform sampler2D picture;  // straight alpha; gray ones and the font are widened to four channels by their swizzle

out vec4 colour;  // multiplied by its alpha

void main() {
  vec4 straight = ink * texture(picture, place);
  colour = vec4(straight.rgb * straight.a, straight.a);
}
