#version 330 core
in vec4 lit;

out vec4 fragment;

void main() { fragment = lit; }
