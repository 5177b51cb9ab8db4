#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

/// @file What tests of random pictures compared with the truth, for docs/exactness.sh, which reads
/// it from their report.

namespace gnomon::test
{

struct Compared
{
  std::size_t pictures = 0;  ///< each with a camera and a light of its own
  std::size_t receivers = 0; ///< that get a shadow ray
  std::size_t traced = 0;    ///< of these, those whose ray was traced all the same
  std::size_t wrong = 0;

  void add(const Compared& other)
  {
    this->pictures += other.pictures;
    this->receivers += other.receivers;
    this->traced += other.traced;
    this->wrong += other.wrong;
  }
};

/// @param technique by its name, with its settings
/// @param scenes their kind
/// @param part what tells several records of one test apart
inline void recordCompared(const std::string& technique, const std::string& scenes,
  const Compared& compared, const std::string& part = "")
{
  const std::string prefix = part.empty() ? "" : part + ".";
  const auto record = [&prefix](const char* name, const std::string& value)
  { testing::Test::RecordProperty(prefix + name, value); };
  record("technique", technique);
  record("scenes", scenes);
  record("pictures", std::to_string(compared.pictures));
  record("receivers", std::to_string(compared.receivers));
  record("traced", std::to_string(compared.traced));
  record("wrong", std::to_string(compared.wrong));
}

} // namespace gnomon::test
