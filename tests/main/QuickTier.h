#pragma once

#include <string>

namespace gnomon::test
{

/// Restrict a filter of GoogleTest (--gtest_filter) to the cases of one tier.
///
/// The quick tier has each plain test. Of each parameterised test it has one value, or as many as
/// `quickValues` says. The test's name determines which values, so the tests of a suite together
/// have most of its values. The slow tier has all other cases.
/// @param tier "quick" or "slow"; any other text leaves the filter as it is
/// @param slow patterns, separated by colons, of cases that are always in the slow tier
std::string filterOfTier(
  const std::string& tier, const std::string& slow, const std::string& filter);

} // namespace gnomon::test
