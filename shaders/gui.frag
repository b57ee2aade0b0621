#version 330 core
in vec2 place;
in vec4 ink;

uniform sampler2D picture;  // straight alpha; gray pictures and the font are swizzled to four channels

out vec4 colour;  // premultiplied alpha

void main() {
  vec4 straight = ink * texture(picture, place);
  colour = vec4(straight.rgb * straight.a, straight.a);
}
