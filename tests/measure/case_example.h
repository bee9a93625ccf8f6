#pragma once

#include <nlohmann/json.hpp>

#include "core/file.h"
#include "measure/solve_case.h"
#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact::measure {

/// A box of two cells held at x = 0 and pulled at x = 2 m, as JSON that a test may change.
inline nlohmann::json example_case() {
  return nlohmann::json::parse(R"({
    "schema": 1,
    "mesh": {"box": {"size_m": [2, 1, 1], "cells": [2, 1, 1]}},
    "element": "T4",
    "materials": [{"law": "neo_hookean", "parameters": {"shear_Pa": 1e4, "lambda_Pa": 4e4, "density_kg_m3": 1000}}],
    "sets": {"root": {"plane": {"axis": "x", "value": 0}}, "tip": {"plane": {"axis": "x", "value": 2}}},
    "conditions": [{"set": "root", "kind": "fix"}, {"set": "tip", "kind": "traction", "value": [100, 0, 0]}],
    "outputs": [{"set": "tip", "quantity": "displacement", "reduce": "mean"}]
  })");
}

/// Writes cases to a folder of its own and reads them.
class CaseFolder {
 public:
  SolveCase load(const nlohmann::json& json) const {
    write_file(folder_ / "case.json", json.dump());
    return load_case(folder_ / "case.json");
  }
  std::string problem(const nlohmann::json& json) const {
    return myotact::testing::complaint(ExitStatus::BadData, [&] { load(json); });
  }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  myotact::testing::TemporaryFolder folder_;
};

}  // namespace myotact::measure
