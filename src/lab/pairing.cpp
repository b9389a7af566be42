#include "lab/pairing.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <mimicry/base/error.h>

#include "base/comma_list.h"
#include "io/number.h"
#include "lab/columns.h"
#include "lab/study_numbers.h"

namespace mimicry::lab {
namespace {

using Row = std::vector<std::string>;

constexpr std::string_view kSameTask[] = {column::kParticipant, column::kStroke,     column::kShape,
                                          column::kCurve,       column::kRepetition, column::kTask};
constexpr std::string_view kFilters[] = {column::kShort, column::kNoisy, column::kInverted,
                                         column::kRejected};

[[noreturn]] void fail(const std::string& what) {
  throw Error(ErrorKind::invalid_input, what);
}

class Columns {
 public:
  Columns(const CsvTable& table, const std::string& name) : table_(table), name_(name) {}
  std::size_t operator[](std::string_view column) const {
    if (const auto at = table_.find(column)) return *at;
    fail(name_ + ": has no column '" + std::string(column) + "'; its columns are " +
         comma_list(std::set<std::string>(table_.columns.begin(), table_.columns.end())));
  }

 private:
  const CsvTable& table_;
  const std::string& name_;
};

bool has_failed(const Row& row, const std::vector<std::size_t>& filters) {
  return std::any_of(filters.begin(), filters.end(),
                     [&row](std::size_t column) { return is_set(row[column]); });
}

struct Pair {
  const Row* a = nullptr;
  const Row* b = nullptr;
};

PairedGroup group_of(const std::string& name, const std::vector<Pair>& pairs,
                     const std::vector<std::size_t>& measures,
                     const std::vector<std::size_t>& filters, const CsvTable& table) {
  PairedGroup group;
  group.name = name;
  const auto participant = table.find(column::kParticipant);
  std::map<std::string, std::size_t> persons;
  for (const std::size_t column : measures)
    group.measures.push_back({table.columns[column], {}, {}});
  for (const Pair& pair : pairs) {
    if (pair.a == nullptr || pair.b == nullptr) {
      ++group.unpaired;
      continue;
    }
    if (has_failed(*pair.a, filters) || has_failed(*pair.b, filters)) {
      ++group.failed;
      continue;
    }
    ++group.pairs;
    group.rows.emplace_back(static_cast<std::size_t>(pair.a - table.rows.data()),
                            static_cast<std::size_t>(pair.b - table.rows.data()));
    const auto number = [](const std::string& cell) {
      return parse_double(cell).value_or(std::numeric_limits<double>::quiet_NaN());
    };
    std::size_t person = 0;
    if (participant)
      person = persons.try_emplace((*pair.a)[*participant], persons.size()).first->second;
    for (std::size_t m = 0; m < measures.size(); ++m) {
      if (participant) group.measures[m].participants.push_back(person);
      group.measures[m].a.push_back(number((*pair.a)[measures[m]]));
      group.measures[m].b.push_back(number((*pair.b)[measures[m]]));
    }
  }
  return group;
}

std::vector<std::size_t> measure_columns(const CsvTable& table, const Columns& columns,
                                         const std::vector<std::string>& wanted,
                                         const std::string& name) {
  std::vector<std::size_t> found;
  for (const std::string& measure : wanted) found.push_back(columns[measure]);
  if (wanted.empty())
    for (const PaperMeasure& measure : paper_measures())
      if (const auto at = table.find(measure.column)) found.push_back(*at);
  if (found.empty())
    fail(name + ": has none of the paper's measures; name columns with --measures");
  return found;
}

// What the table's cells say for a value that is given by a study's number.
std::string cell_of(std::string_view column, const std::string& value) {
  if (column == column::kMethod) return name_of_method(value);
  if (column == column::kShape) return name_of_shape(value);
  return value;
}

}  // namespace

std::string group_name(std::string_view column, std::string_view value) {
  return std::string(column) + " " + std::string(value);
}

std::vector<PairedGroup> pair_rows(const CsvTable& table, const PairingOptions& options,
                                   const std::string& name) {
  const Columns columns(table, name);
  const std::size_t method = columns[column::kMethod];
  const std::vector<std::size_t> measures = measure_columns(table, columns, options.measures, name);
  std::vector<std::size_t> identity, filters;
  for (const std::string_view column : kSameTask)
    if (const auto at = table.find(column)) identity.push_back(*at);
  if (!options.keep_failed)
    for (const std::string_view column : kFilters)
      if (const auto at = table.find(column)) filters.push_back(*at);
  std::vector<std::pair<std::size_t, std::string>> without;
  for (const std::string& rule : options.without) {
    const std::size_t equals = rule.find('=');
    if (equals == std::string::npos) fail("--without " + rule + ": write COLUMN=VALUE");
    const std::string column = rule.substr(0, equals);
    without.emplace_back(columns[column], cell_of(column, rule.substr(equals + 1)));
  }
  const std::optional<std::size_t> by =
      options.by == column::kTask ? table.find(column::kTask) : columns[options.by];
  const std::string method_a = name_of_method(options.method_a),
                    method_b = name_of_method(options.method_b);

  std::vector<Row> order;  // keys as they first come
  std::map<Row, Pair> pairs;
  std::set<std::string> methods;
  bool has_a = false, has_b = false;
  for (const Row& row : table.rows) {
    if (std::any_of(without.begin(), without.end(),
                    [&row](const auto& rule) { return row[rule.first] == rule.second; }))
      continue;
    methods.insert(row[method]);
    const bool is_a = row[method] == method_a;
    const bool is_b = !is_a && row[method] == method_b;
    if (!is_a && !is_b) continue;
    (is_a ? has_a : has_b) = true;
    Row key;
    for (const std::size_t column : identity) key.push_back(row[column]);
    Pair& pair = pairs[key];
    if (pair.a == nullptr && pair.b == nullptr) order.push_back(key);
    const Row*& side = is_a ? pair.a : pair.b;
    if (side != nullptr) {
      std::string what;
      for (std::size_t i = 0; i < key.size(); ++i)
        what += (i > 0 ? ", " : "") + table.columns[identity[i]] + " " + key[i];
      fail(name + ": two rows of method " + row[method] + " for " + what +
           "; they cannot be paired");
    }
    side = &row;
  }
  for (const auto& [has, wanted] :
       {std::pair{has_a, options.method_a}, std::pair{has_b, options.method_b}})
    if (!has)
      fail(methods.empty()
               ? name + ": no row is left to compare"
               : name + ": has no row of method '" + wanted + "', only of " + comma_list(methods));

  std::map<std::string, std::vector<Pair>> by_value;
  std::vector<Pair> all;
  for (const Row& key : order) {
    const Pair& pair = pairs[key];
    all.push_back(pair);
    if (by) by_value[(*(pair.a != nullptr ? pair.a : pair.b))[*by]].push_back(pair);
  }
  std::vector<PairedGroup> groups;
  if (by_value.size() > 1)
    for (const auto& [value, some] : by_value)
      groups.push_back(group_of(group_name(options.by, value), some, measures, filters, table));
  groups.push_back(group_of(std::string(kAllRows), all, measures, filters, table));
  return groups;
}

}  // namespace mimicry::lab
