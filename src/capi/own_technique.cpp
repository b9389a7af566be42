#include <algorithm>
#include <array>

#include "capi/handles.h"
#include "geodesic/site.h"
#include "technique/options.h"

using namespace mimicry;
using namespace mimicry::capi;

namespace {

constexpr int32_t kMostOptions = 64;
constexpr std::size_t kMostMemory = std::size_t{1} << 20;

std::string copied(const char* text) {
  return text ? text : "";
}

// Options lie one after the other, each in as many bytes as the largest kind needs.
constexpr std::size_t kOptionBytes = 3 * sizeof(double);

OptionInfo option_of(const TechniqueInfo& row, const mimicry_option_info& given,
                     std::size_t number) {
  OptionInfo info;
  info.name = copied(given.name);
  const std::string label = option_label(row, info.name);
  info.unit = copied(given.unit);
  info.description = copied(given.description);
  info.lowest = given.lowest;
  info.highest = given.highest;
  info.offset = number * kOptionBytes;
  switch (given.kind) {
    case MIMICRY_OPTION_BOOLEAN:
      info.kind = OptionKind::boolean;
      info.lowest = 0.0;
      info.highest = 1.0;
      break;
    case MIMICRY_OPTION_NUMBER:
      info.kind = OptionKind::number;
      break;
    case MIMICRY_OPTION_DIRECTION:
      info.kind = OptionKind::direction;
      break;
    case MIMICRY_OPTION_CHOICE:
      info.kind = OptionKind::choice;
      if (given.choice_count > 0) require(given.choices, (label + ": choices").c_str());
      for (int32_t i = 0; i < given.choice_count; ++i)
        info.choices.emplace_back(text(given.choices[i], (label + ": a choice's name").c_str()));
      info.lowest = 0.0;
      info.highest = static_cast<double>(info.choices.size()) - 1.0;
      break;
    default:
      throw Error(ErrorKind::invalid_input, label + " is of no known kind (" +
                                                std::to_string(static_cast<int>(given.kind)) + ")");
  }
  return info;
}

static_assert(static_cast<int>(Answer::section) == MIMICRY_SECTION &&
              static_cast<int>(Answer::replaced) == MIMICRY_REPLACED);

// A caller's step in the words of the library. Its values are laid out anew for every frame, on the
// stack: nothing is allocated.
class CallersStep {
 public:
  CallersStep(const mimicry_own_technique& own, std::vector<OptionInfo> options)
      : step_(own.step), user_(own.user), options_(std::move(options)) {}

  TechniqueStep operator()(const Canvas& canvas, const Frame& frame, const void* options,
                           void* memory) const {
    std::array<double, 3 * kMostOptions> values{};
    lay_out(options, values.data());
    // The target is the canvas's for as long as the call lasts.
    static const auto no_view = std::make_shared<mimicry_target_view>();
    auto* surface = const_cast<Target*>(&canvas.target);  // the handle is const
    const mimicry_target target{
        {std::shared_ptr<void>(), surface},
        no_view,
        {std::shared_ptr<void>(), canvas.projector ? &canvas.projector : nullptr}};
    const mimicry_frame given = from_frame(frame);
    mimicry_surface_point point{};
    point.face = kNone;
    const mimicry_answer answer =
        step_(user_, &target, &given, canvas.metres_per_unit, values.data(), memory, &point);
    if (answer <= MIMICRY_NO_POINT || answer > MIMICRY_REPLACED) return {};
    const TriangleMesh& mesh = canvas.target.mesh();
    const SurfacePoint q{point.face, vec3(point.barycentric)};
    if (!is_on(mesh, q)) return {};
    const SurfacePoint found = source_point(mesh, normalised(q));
    return {static_cast<Answer>(answer), found, canvas.target.position(found)};
  }

 private:
  void lay_out(const void* options, double* to) const {
    for (const OptionInfo& option : options_) {
      const OptionValue value = read_option(option, options);
      to = std::copy(value.begin(), value.end(), to);
    }
  }

  mimicry_step_function step_;
  void* user_;
  std::vector<OptionInfo> options_;
};

TechniqueInfo row_of(const mimicry_own_technique& own) {
  TechniqueInfo row;
  row.name = text(own.name, "name");
  row.title = copied(own.title);
  row.sentence = copied(own.sentence);
  row.description = copied(own.description);
  row.color = own.color;
  if (own.steering != MIMICRY_AIMED && own.steering != MIMICRY_MOVED)
    throw Error(ErrorKind::invalid_input, "technique '" + row.name +
                                              "' is steered in no known way (" +
                                              std::to_string(static_cast<int>(own.steering)) + ")");
  row.steering = own.steering == MIMICRY_AIMED ? Steering::aims : Steering::moves;
  row.anchored = own.anchored != 0;
  row.needs_bake = own.needs_bake != 0;
  row.rank = own.rank;
  if (own.option_count < 0 || own.option_count > kMostOptions)
    throw Error(ErrorKind::invalid_input,
                "technique '" + row.name + "' has " + std::to_string(own.option_count) +
                    " options; give 0 to " + std::to_string(kMostOptions));
  if (own.memory_size > kMostMemory)
    throw Error(ErrorKind::invalid_input,
                "technique '" + row.name + "' asks for " + std::to_string(own.memory_size) +
                    " bytes of memory; give at most " + std::to_string(kMostMemory));
  if (!own.step)
    throw Error(ErrorKind::invalid_input, "technique '" + row.name + "': step is NULL");
  if (own.option_count > 0) require(own.options, "options");
  const auto count = static_cast<std::size_t>(own.option_count);
  row.default_options = Block(count * kOptionBytes);
  for (std::size_t i = 0; i < count; ++i) {
    OptionInfo option = option_of(row, own.options[i], i);
    const std::size_t numbers = option.kind == OptionKind::direction ? 3 : 1;
    set_default(row, option, {own.options[i].defaults, numbers});
    row.options.push_back(std::move(option));
  }
  row.first_memory = Block(own.memory_size);
  row.step = CallersStep(own, row.options);
  return row;
}

}  // namespace

mimicry_status mimicry_technique_register(const mimicry_own_technique* own, int32_t* number) {
  return guarded([&] {
    require(own, "technique");
    const TechniqueInfo& row = register_technique(row_of(*own));
    if (number) *number = static_cast<int32_t>(&row - techniques().data());
  });
}
