#pragma once

/// A class without a reason for its number of members.
class Many {
 public:
  int function(int a);

 private:
  int a_, b_, c_, d_, e_, f_, g_, h_;
  int i_, j_, k_, l_, m_, n_, o_;
  int p_ = 0;
};
