#version 330 core
// Flat figures in logical pixels from the top left corner.
layout(location = 0) in vec2 a_position;
layout(location = 1) in vec4 a_color;
uniform vec2 u_size; // of the view, logical pixels
out vec4 v_color;
void main() {
    gl_Position = vec4(a_position.x / u_size.x * 2.0 - 1.0, 1.0 - a_position.y / u_size.y * 2.0, 0.0, 1.0);
    v_color = a_color;
}
