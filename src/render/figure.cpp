#include "render/figure.h"

#include <algorithm>
#include <cmath>

#include "render/checks.h"
#include "render/palette.h"
#include "render/text.h"

namespace mimicry::render {
namespace {

/// Height of a line of text for a picture of this size.
double text_size(int width, int height) {
  return std::max(13.0, 0.036 * std::min(width, height));
}

/// A disc with a soft rim.
void draw_swatch(Image& image, double x, double y, double radius, const Color& color) {
  for (int v = static_cast<int>(y - radius) - 1; v <= static_cast<int>(y + radius) + 1; ++v) {
    for (int u = static_cast<int>(x - radius) - 1; u <= static_cast<int>(x + radius) + 1; ++u) {
      const double d = std::hypot(u + 0.5 - x, v + 0.5 - y);
      image.blend(u, v, color, std::clamp(radius + 0.5 - d, 0.0, 1.0));
    }
  }
}

constexpr Color kOutlineColor{0.45, 0.45, 0.45};

/// A piece of text with a swatch before it where `swatch` says so.
struct Entry {
  std::string text;
  Color color;
  bool swatch = true;
};

double entry_width(const Entry& entry, double size) {
  return (entry.swatch ? 0.95 * size : 0.0) + text_width(entry.text, size);
}

void draw_entry(Image& image, const Entry& entry, double x, double baseline, double size) {
  if (entry.swatch) {
    // With an outline, or what is white would not be seen.
    draw_swatch(image, x + 0.32 * size, baseline - 0.29 * size, 0.34 * size, kOutlineColor);
    draw_swatch(image, x + 0.32 * size, baseline - 0.29 * size, 0.28 * size, entry.color);
    x += 0.95 * size;
  }
  draw_text(image, entry.text, x, baseline, size, kInkColor);
}

std::vector<Entry> legend_of(const Scene& scene) {
  std::vector<Entry> entries;
  for (const Tube& tube : scene.tubes) {
    const auto same = [&](const Entry& e) { return e.text == tube.label; };
    if (!tube.label.empty() && std::none_of(entries.begin(), entries.end(), same)) {
      entries.push_back({tube.label, tube.color});
    }
  }
  return entries;
}

/// Entries broken into lines that fit the width.
std::vector<std::vector<Entry>> lines_of(const std::vector<Entry>& entries, double size,
                                         int width) {
  std::vector<std::vector<Entry>> lines;
  double used = 0.0;
  for (const Entry& entry : entries) {
    const double w = entry_width(entry, size) + 1.2 * size;
    if (lines.empty() || used + w > width - size) {
      lines.emplace_back();
      used = 0.0;
    }
    lines.back().push_back(entry);
    used += w;
  }
  return lines;
}

/// Draws a line of entries centred in width pixels from x.
void draw_line(Image& image, const std::vector<Entry>& line, double x, int width, double baseline,
               double size) {
  double total = -1.2 * size;
  for (const Entry& entry : line) total += entry_width(entry, size) + 1.2 * size;
  x += 0.5 * (width - total);
  for (const Entry& entry : line) {
    draw_entry(image, entry, x, baseline, size);
    x += entry_width(entry, size) + 1.2 * size;
  }
}

/// All surfaces once and all tubes, for one camera that suits all panels.
Scene merged(std::span<const Scene> panels) {
  Scene all;
  all.up = panels.front().up;
  for (const Scene& panel : panels) {
    for (const Surface& surface : panel.surfaces) {
      const auto same = [&](const Surface& s) { return s.mesh == surface.mesh; };
      if (std::none_of(all.surfaces.begin(), all.surfaces.end(), same)) {
        all.surfaces.push_back(surface);
      }
    }
    all.tubes.insert(all.tubes.end(), panel.tubes.begin(), panel.tubes.end());
  }
  return all;
}

int columns_for(int panels, double width, double height) {
  int best = 1;
  double best_off = kInfinity;
  for (int columns = 1; columns <= panels; ++columns) {
    const int rows = (panels + columns - 1) / columns;
    const double empty = rows * columns - panels;
    const double off = std::abs(std::log(columns * width / (rows * height) / 1.6)) + 0.15 * empty;
    if (off < best_off) {
      best_off = off;
      best = columns;
    }
  }
  return best;
}

}  // namespace

Image picture(const Scene& scene, const CameraOptions& camera, const RenderOptions& options) {
  const double size = text_size(options.width, options.height);
  const auto lines = lines_of(legend_of(scene), size, options.width);
  const int legend =
      lines.empty()
          ? 0
          : static_cast<int>(std::lround(size * (1.25 * static_cast<double>(lines.size()) + 0.6)));
  if (legend >= options.height) {
    refuse("picture: " + std::to_string(options.height) +
           " pixels are too low for the legend; make the picture higher");
  }
  RenderOptions inner = options;
  inner.height -= legend;
  CameraOptions framed = camera;
  framed.aspect = static_cast<double>(inner.width) / inner.height;
  const Image drawn = render(scene, choose_camera(scene, framed), inner);
  if (legend == 0) return drawn;
  Image image(options.width, options.height, options.background);
  image.paste(drawn, 0, 0);
  double baseline = inner.height + size;
  for (const auto& line : lines) {
    draw_line(image, line, 0.0, options.width, baseline, size);
    baseline += 1.25 * size;
  }
  return image;
}

Image figure(std::span<const Scene> panels, const CameraOptions& camera,
             const FigureOptions& options) {
  if (panels.empty()) refuse("figure: no panels; give at least one scene");
  if (options.columns < 0 || options.gap < 0 || options.gap > 1000) {
    refuse("figure: columns must not be negative and the gap must lie in 0..1000 pixels");
  }
  const int count = static_cast<int>(panels.size());
  const int width = options.panel.width;
  const double size = 1.25 * text_size(width, options.panel.height);
  const bool captions =
      std::any_of(panels.begin(), panels.end(), [](const Scene& s) { return !s.caption.empty(); });
  const int caption = captions ? static_cast<int>(std::lround(1.6 * size)) : 0;
  const int height = options.panel.height + caption;
  const int columns =
      std::min(count, options.columns > 0 ? options.columns : columns_for(count, width, height));
  const int rows = (count + columns - 1) / columns;

  CameraOptions framed = camera;
  framed.aspect = static_cast<double>(width) / std::max(1, options.panel.height);
  Camera chosen;
  if (options.one_camera) chosen = choose_camera(merged(panels), framed);
  Image image;
  for (int i = 0; i < count; ++i) {
    const Scene& panel = panels[static_cast<std::size_t>(i)];
    if (!options.one_camera) chosen = choose_camera(panel, framed);
    const Image drawn = render(panel, chosen, options.panel);
    if (i == 0) {  // the panel's options have been checked
      image = Image(columns * width + (columns - 1) * options.gap,
                    rows * height + (rows - 1) * options.gap, options.panel.background);
    }
    const int x = (i % columns) * (width + options.gap);
    const int y = (i / columns) * (height + options.gap);
    image.paste(drawn, x, y);
    if (!panel.caption.empty()) {
      draw_line(image, {{panel.caption, panel.caption_color, panel.caption_swatch}}, x, width,
                y + options.panel.height + 0.95 * size, size);
    }
  }
  return image;
}

}  // namespace mimicry::render
