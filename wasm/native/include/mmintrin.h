// Eigen asks for this header of MMX beside those of SSE2, uses nothing of it, and emscripten has none.
