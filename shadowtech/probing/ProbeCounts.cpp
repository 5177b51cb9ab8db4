#include "shadowtech/probing/ProbeCounts.h"

#include <cmath>

namespace gnomon
{
namespace
{

/// Return an end of Wilson's interval of a share, where k of n were counted.
/// @param z standard deviations; negative for the lower end
double wilson(double k, double n, double z)
{
  const double half = z * std::sqrt(k * (1.0 - k / std::max(n, 1.0)) + 0.25 * z * z);
  return (k + 0.5 * z * z + half) / (n + z * z);
}

double wilson(const WrongProbes& probes, double z)
{
  return wilson(static_cast<double>(probes.wrong), static_cast<double>(probes.asked), z);
}

} // namespace

double WrongProbes::leastShare() const
{
  return wilson(*this, -2.0);
}

double WrongProbes::mostShare() const
{
  return wilson(*this, 2.0);
}

void SquaredErrors::add(const SquaredErrors& others)
{
  this->points += others.points;
  this->sum += others.sum;
  this->sumOfSquares += others.sumOfSquares;
  this->expected = std::max(this->expected, others.expected);
}

double SquaredErrors::rms(double z) const
{
  const double size =
    this->sum > 0.0 ? std::max(this->sumOfSquares / this->sum, this->expected) : this->expected;
  return size > 0.0 && this->points > 0
    ? std::sqrt(size * wilson(this->sum / size, static_cast<double>(this->points), z))
    : 0.0;
}

} // namespace gnomon
