#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include <mimicry/base/error.h>
#include <mimicry/base/types.h>
#include <mimicry/mesh/triangle_mesh.h>
#include <mimicry/stroke/stroke.h>

#include "base/float_traps.h"

namespace mimicry {

// Reading of typed fields out of a parsed value. Each function throws Error(invalid_input) with
// `where` and the field's name for a field that is missing or of another kind.

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

class JsonText;

[[noreturn]] inline void json_fail(const std::string& where, const std::string& what) {
  throw Error(ErrorKind::invalid_input, where + ": " + what);
}

inline const Json& member(const Json& object, const char* key, const std::string& where) {
  if (!object.is_object()) json_fail(where, "is not an object");
  const auto it = object.find(key);
  if (it == object.end()) json_fail(where, std::string("'") + key + "' is missing");
  return *it;
}

inline const Json& array(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_array()) json_fail(where, std::string("'") + key + "' is not an array");
  return value;
}

inline double number(const Json& value, const std::string& where) {
  if (!value.is_number()) json_fail(where, "is not a number");
  return value.get<double>();
}

inline std::string text(const Json& value, const std::string& where) {
  if (!value.is_string()) json_fail(where, "is not a string");
  return value.get<std::string>();
}

inline Index index(const Json& value, const std::string& where) {
  if (!value.is_number_integer() || value.get<std::int64_t>() < 0 ||
      value.get<std::int64_t>() > std::numeric_limits<Index>::max())
    json_fail(where, "is not a number of a face, vertex or point");
  return value.get<Index>();
}

template <int N>
Eigen::Matrix<double, N, 1> vector(const Json& value, const std::string& where) {
  if (!value.is_array() || value.size() != N)
    json_fail(where, "is not an array of " + std::to_string(N) + " numbers");
  Eigen::Matrix<double, N, 1> v;
  for (int i = 0; i < N; ++i) v[i] = number(value[static_cast<std::size_t>(i)], where);
  return v;
}

/// Written coordinates sum to 1 up to rounding; what does not is another thing than a point.
inline Vec3 barycentrics(const Json& value, const std::string& where) {
  const Vec3 b = vector<3>(value, where);
  if (std::abs(b.sum() - 1.0) > 1e-6 || b.minCoeff() < -1e-6)
    json_fail(where, "'bary' is not three numbers >= 0 that sum to 1");
  return b;
}

/// Quaternions are written x, y, z, w, as in glTF and WebXR.
inline Quat quaternion(const Json& value, const std::string& where) {
  return Quat(vector<4>(value, where));
}

/// {"program", "seed", "technique"}, the last only where there is one.
Simulation read_simulation(const Json& value, const std::string& where);
void write_simulation(JsonText& out, const Simulation& simulation);

}  // namespace mimicry
