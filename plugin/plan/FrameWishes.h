#pragma once

#include "lights/LightManager.h"
#include "plugin/plan/CostModel.h"
#include "shadowtech/sky/Sky.h"

#include <glm/glm.hpp>

#include <optional>

namespace gnomon
{

/// Requested way of visibility to the picture.
enum class RouteWish
{
  Auto,
  Inline,
  Image,
  Deferred
};

/// The pass's settings of the sky.
struct SkyWish
{
  double intensity = 0.0; ///< 0: there is no sky
  glm::vec3 colour{ 1.0f };
  SkyModel model = SkyModel::Uniform;
  glm::dvec3 upWorld{ 0.0, 0.0, 1.0 }; ///< of any length but 0
  double distanceWorld = 0.0;          ///< beyond which nothing hides it; 0: no limit
  int directions = 256;
};

/// The pass's settings for a frame.
struct FrameWishes
{
  RouteWish route = RouteWish::Auto;
  bool keepVisibility = false; ///< true if visibility is asked for as data
  bool measureStages = false;
  Casting casting = Casting::Auto;
  bool isShared = false;     ///< true if several processes draw the picture
  int reductionFactor = 1;   ///< of the delegate's viewport, whose lower left part is the picture
  double memoryBudget = 0.0; ///< bytes of lights' maps and images of visibility; 0: none
  SkyWish sky;
  bool translucentCasters = false; ///< true if translucent props cast without being asked
  bool volumeCasters = false;      ///< likewise volumes
  int volumeResolution = 256;      ///< of VolumeStack
  bool volumesReceive = true;      ///< true if samples of volumes show shadows
  bool smoothTerminators = true;   ///< true if receivers may lie on the surface that normals imply
  ///@{
  /// For lights that leave their technique to the pass.
  double maximumError = 0.005;    ///< share of wrong pixels of hard shadows in moving frames
  double maximumSoftError = 0.03; ///< root mean square error of soft shadows
  double timeBudget = 0.0;        ///< milliseconds for a moving frame; 0: none
  double windowTime = 0.0;        ///< milliseconds that the window has for a moving frame; 0: any
  std::optional<CostFactors> factors; ///< of this machine; none: the defaults
  ///@}

  /// True if a sky is asked for that can be shown.
  bool showsSky() const { return this->sky.intensity > 0.0 && !this->isShared; }
};

} // namespace gnomon
