#version 330 core
uniform sampler2D u_picture; // alpha multiplied in, rows from the top
in vec2 v_at;
out vec4 o_color;

void main() { o_color = textureLod(u_picture, v_at, 0.0); }
