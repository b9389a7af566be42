#pragma once

namespace mimicry::render {

/// The bytes of DejaVu Sans (TrueType), linked into the program.
const unsigned char* font_data();

}  // namespace mimicry::render
