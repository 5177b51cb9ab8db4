#pragma once

#include <string>

namespace gnomon::test
{

/// Restrict a filter of GoogleTest (--gtest_filter) to the cases of one tier.
///
/// The quick tier has each plain test, and of each parameterised test one value, or as many as
/// `quickValues` says. Which value depends on the test's name, so that the tests of a suite
/// have between them most of its values. The slow tier has all other cases.
/// @param tier "quick" or "slow"; any other text leaves the filter as it is
/// @param slow patterns, with : between them, of cases that are in the slow tier in any case
std::string filterOfTier(
  const std::string& tier, const std::string& slow, const std::string& filter);

} // namespace gnomon::test
