#pragma once

// The cost of importing the thousandth recording, against the tenth.

#include <array>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bench/annotation_corpus.h"
#include "bench/measure.h"
#include "signweave/database/import.h"

namespace signweave::bench {

/// Imports files into one database, one at a time.
class Importing {
 public:
  enum class How {
    open,      ///< into a database that stays open
    reopened,  ///< the database is opened for each
    verb,  ///< opened for each, and everything is done that `signweave import` does at its end: tables merged, joins
           ///< learned
  };
  Importing(std::filesystem::path folder, const std::vector<std::filesystem::path>& files)
      : folder_(std::move(folder)), files_(files) {
    Database::create(folder_, {});
    options_.sign_tiers = {{"BenchGloss", Hand::right, ""}};
    options_.phase_tiers = {"BenchPhase"};
  }

  /// Seconds.
  double next(How how) {
    ImportJob job;
    job.name = fmt::format("r{:06}", count_);
    job.annotation = files_[count_++ % files_.size()];
    if (how != How::open) database_.reset();
    return seconds_of([&] {
      if (!database_) database_ = std::make_unique<Database>(folder_, kv::Access::read_write);
      import_recording(*database_, job, options_);
      if (how == How::verb) {
        database_->merge();
        database_->learn();
      }
      if (how != How::open) database_.reset();
    });
  }
  std::size_t count() const noexcept { return count_; }

 private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
  std::unique_ptr<Database> database_;
  ImportOptions options_;
  std::size_t count_ = 0;
};

inline double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Imports recordings 5 to 15 of several databases, interleaved with as many around the thousandth of one, from the
/// same files.
inline void measure_growth(const std::vector<AnnotationDocument>& sources, const std::filesystem::path& folder,
                           bool quick) {
  const std::size_t many = quick ? 60 : 1000;
  constexpr std::size_t kFirst = 5;
  constexpr std::size_t kWindow = 11;  // up to the fifteenth
  const std::size_t batches = quick ? 1 : 10;
  std::vector<std::filesystem::path> files;
  std::mt19937 random(11);
  for (std::size_t i = 0; i < 5; ++i) {  // from the shortest to the longest
    AnnotationDocument document = sources[i * (sources.size() - 1) / 4];
    add_signs(document, random, 100, 100);
    files.push_back(folder / fmt::format("growth{}.eaf", i));
    eaf::write(files.back(), document);
  }
  using How = Importing::How;
  for (const auto& [how, name] :
       {std::pair(How::open, "open"), std::pair(How::reopened, "reopened"), std::pair(How::verb, "verb")}) {
    const std::filesystem::path target = folder / fmt::format("growth_{}", name);
    Importing large(target, files);
    // As many batches end after the thousandth recording as before it.
    while (large.count() + batches * kWindow / 2 < many) large.next(How::open);
    std::vector<double> few, much, ratios;
    for (std::size_t batch = 0; batch < batches; ++batch) {
      Importing small(target.string() + fmt::format("_{}", batch), files);
      while (small.count() + 1 < kFirst) small.next(how);
      while (small.count() % files.size() != large.count() % files.size()) large.next(how);
      for (std::size_t i = 0; i < kWindow; ++i) {
        few.push_back(small.next(how));
        much.push_back(large.next(how));
        ratios.push_back(much.back() / few.back());
      }
    }
    print(fmt::format("import_one/{}/{}th_to_10th", name, many), 1e3, "ms",
          Compared{median(much), median(few), median(ratios)}, "<= 1.5");
    // Including the merges of tables that fall within these imports.
    print(fmt::format("import_one/{}/{}th_to_10th/mean", name, many), 1e3 * mean(much), "ms", 1e3 * mean(few),
          mean(much) / mean(few), "-");
  }
}

}  // namespace signweave::bench
