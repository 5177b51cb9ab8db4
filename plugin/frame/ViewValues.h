#pragma once

#include "lights/vtkGnomonVersions.h"
#include "plugin/frame/TechniqueCache.h"
#include "plugin/frame/ValueKey.h"
#include "plugin/ranks/SharedReceivers.h"

#include "plugin/frame/DeferredPicture.h"
#include "plugin/frame/EdgeImage.h"
#include "shadowtech/base/ReceiverBoxes.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/VisibilityLayers.h"
#include "shadowtech/base/vtkGnomonFrameCounts.h"
#include "shadowtech/sky/SkyImage.h"
#include "shadowtech/tracing/EdgeSamples.h"
#include "shadowtech/tracing/TracedTiles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

///@{
/// Parts of the receivers' key.
inline constexpr const char* propsPart = "the props in view";
inline constexpr const char* snapshotPart = "the snapshot";
///@}

/// The receivers stage's value: which triangle each pixel shows.
struct ReceiversValue
{
  std::optional<ValueKey> key;             ///< none: there is no value
  std::size_t number = 0;                  ///< number of this image among all of a renderer's views
  ReceiverTarget target;                   ///< image route
  DeferredPicture deferred;                ///< deferred route
  std::vector<DrawnSurface> drawnSurfaces; ///< to which the fragments refer
  ReceiverImages images;                   ///< on the CPU, once they are read
  std::size_t numberOfImages = 0;          ///< `number` of these images
  std::vector<glm::vec2> fragmentsBefore;  ///< of the images read before these
  std::size_t numberBefore = 0;            ///< their `number`
  ReceiverPixels pixels;                   ///< storage of `onCpu`, if it is used
  std::optional<Receivers> onCpu;          ///< made with `images`
  SharedReceivers shared;                  ///< of all processes, if several draw the picture
  std::optional<ReceiverBoxes> boxes;      ///< of `onCpu`, if it stores them
  int framesTraced = 0;                    ///< frames that traced lights from them
};

/// The visibility stage's value for one light. The image itself is in the view's layers.
struct VisibilityValue
{
  std::optional<ValueKey> key;       ///< none: there is no value
  int samples = 0;                   ///< of an area light's image while it refines
  LightCounts counts;                ///< of the frame that computed it
  std::optional<double> tracedShare; ///< of its tiles, the part that had rays; none: not counted
  std::vector<std::string> notes;    ///< its notes (FrameCounts::notes)
  int edgeSamples = 1;               ///< LightPlan::edgeSamples of the picture's edges
  std::vector<EdgePixel> edges;      ///< of the picture, if it smooths any
  bool classified = false;
  std::vector<std::uint8_t> classes; ///< of each pixel, if `classified`
  ///@{
  /// For a light whose image may reuse tiles. The image itself, unless it is a bit of the layers.
  std::vector<float> onCpu;
  TracedTiles tiles;
  std::size_t receiversNumber = 0; ///< ReceiversValue::number of the traced receivers
  ///@}

  /// Drop classes and tiles of the last image.
  void dropTiles();
  std::size_t bytes() const;
};

/// The sky stage's value. The view itself is in the view's layers.
struct SkyValue
{
  std::optional<ValueKey> key; ///< none: there is no value
  std::optional<SkyImage> image;
  std::optional<int> layer; ///< that has its view; none: no layer has
};

/// One view's values, cached from frame to frame.
struct ViewValues
{
  std::size_t shown = 0; ///< hash of lights, camera and props, as RenderManager::changes() noted it
  ReceiversValue receivers;
  TechniqueCache techniques; ///< of lights whose maps are fitted to this view's camera
  VisibilityLayers layers;
  std::vector<VisibilityValue> visibility; ///< by casting light
  EdgeImage edges;                         ///< of all lights, on the image route
  bool marksEdges = false;                 ///< bits mark edge pixels
  SkyValue sky;

  std::size_t bytesOfImages() const;
};

/// The views of a renderer: an eye, a part of a window in tiles.
class RendererViews
{
public:
  /// Return the values of the view that a renderer is about to draw. Views that were not drawn for
  /// a while are dropped, since each has images of the picture's size.
  ViewValues& of(vtkRenderer* renderer);

  std::size_t bytesOfImages() const;
  std::size_t bytesOfMaps() const;

private:
  struct Name
  {
    int leftEye;
    std::array<double, 4> tile; ///< of the window

    bool operator==(const Name& other) const
    {
      return this->leftEye == other.leftEye && this->tile == other.tile;
    }
  };
  struct View
  {
    Name name;
    std::uint64_t lastDrawn = 0; ///< by count_
    ViewValues values;
  };
  std::list<View> views_;
  std::uint64_t count_ = 0; ///< of views drawn
};

} // namespace gnomon
