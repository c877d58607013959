#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "bench/measure.h"

namespace signweave::bench {

/// The results of one kind of measurement over many files.
class Table {
 public:
  Table(std::string what, std::string unit, double scale, std::string goal, bool each)
      : what_(std::move(what)), unit_(std::move(unit)), scale_(scale), goal_(std::move(goal)), each_(each) {}

  void add(const std::string& file, const Compared& compared) {
    if (each_) bench::print(fmt::format("{}/{}", what_, file), scale_, unit_, compared, goal_);
    rows_.push_back({file, compared});
  }
  void print() {
    if (rows_.empty() || (each_ && rows_.size() == 1)) return;  // or reported already
    std::sort(rows_.begin(), rows_.end(),
              [](const Row& a, const Row& b) { return a.compared.ratio < b.compared.ratio; });
    if (rows_.size() > 1) {
      bench::print(fmt::format("{}/median_of_{}", what_, rows_.size()), scale_, unit_, rows_[rows_.size() / 2].compared,
                   goal_);
    }
    const std::string worst = rows_.size() > 1 ? "worst:" : "";
    bench::print(fmt::format("{}/{}{}", what_, worst, rows_.back().file), scale_, unit_, rows_.back().compared, goal_);
  }

 private:
  struct Row {
    std::string file;
    Compared compared;
  };
  std::string what_, unit_;
  double scale_;
  std::string goal_;
  bool each_;
  std::vector<Row> rows_;
};

}  // namespace signweave::bench
