#include <algorithm>
#include <iostream>

#include <spdlog/spdlog.h>

#include "app/options.h"
#include "core/exit_status.h"
#include "core/file.h"
#include "measure/validation/report.h"
#include "measure/validation/validation.h"

namespace myotact::app {

int validate(const Options& options) {
  const auto cases = measure::select_cases(measure::load_cases(measure::validation_folder()), options.filter);
  if (options.report) require_writable(*options.report);  // before cases that may be long
  std::vector<measure::CaseResult> results;
  for (const auto& next : cases) {
    if (next.slow) spdlog::info("{} takes a while ({} of {})", next.name, results.size() + 1, cases.size());
    results.push_back(measure::run_case(next));
  }
  if (options.report) write_file(*options.report, measure::validation_html(results));
  std::cout << (options.json ? measure::validation_json(results) : measure::validation_table(results)) << std::flush;
  const bool passed = std::all_of(results.begin(), results.end(), [](const auto& result) { return result.passed(); });
  return static_cast<int>(passed ? ExitStatus::Done : ExitStatus::CheckFailed);
}

}  // namespace myotact::app
