// Node has a fetch, which knows no files: what emscripten finds instead is its own reader of files.
var fetch;
