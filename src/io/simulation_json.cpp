#include "io/json_text.h"

namespace mimicry {

Simulation read_simulation(const Json& value, const std::string& where) {
  Simulation simulation;
  simulation.program = text(member(value, "program", where), where + ": program");
  const Json& seed = member(value, "seed", where);
  if (!seed.is_number_integer() || (!seed.is_number_unsigned() && seed.get<std::int64_t>() < 0))
    json_fail(where + ": seed", "is not a whole number from 0");
  simulation.seed = seed.get<std::uint64_t>();
  if (value.contains("technique"))
    simulation.technique = text(value["technique"], where + ": technique");
  return simulation;
}

void write_simulation(JsonText& out, const Simulation& simulation) {
  out.begin('{').member("program", simulation.program).member("seed", simulation.seed);
  if (!simulation.technique.empty()) out.member("technique", simulation.technique);
  out.end('}');
}

}  // namespace mimicry
