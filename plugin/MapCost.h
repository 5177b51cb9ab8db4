#ifndef gnomon_plugin_MapCost_h
#define gnomon_plugin_MapCost_h

#include <glm/glm.hpp>

#include <optional>
#include <string>
#include <vector>

namespace gnomon
{

/// When a light's map is worth its time, of techniques that show the same without one (TechniqueInfo::mapIsOptional):
/// all is traced until what that took comes to what the map costs, and a map that does not pay is given up.
///
/// It is the ski rental problem (Karlin, Manasse, Rudolph and Sleator, "Competitive snoopy caching", 1988): to trace is to
/// rent, to draw a map is to buy, and nobody knows how long nothing will change. Maps of one light follow each other,
/// so that there is an account besides: a map is charged to it, and what it saves is paid in. So lights that keep changing
/// soon after their maps were drawn ask for more and more tracing before the next one, and those whose maps have earned
/// more than they cost get the next one sooner. Over any sequence of frames, where a map always costs the same and no frame with
/// it takes longer than one without, all takes no longer than 1.1 times tracing all, and mostDebtMaps maps; and no longer than 11 times
/// drawing a map whenever nothing has changed for a frame.
///
/// Times are handed in, in milliseconds of wall clock: nothing here draws, or looks at a clock.
class MapCost
{
public:
  /// How a frame finds the light's map.
  enum class Situation
  {
    Changed, ///< there is none that serves, and what it would be drawn from or for was another in the frame before
    Still,   ///< there is none that serves, and nothing has changed since the frame before
    Mapped   ///< there is one
  };
  /// What becomes of the map in the frame.
  enum class Plan
  {
    Trace,   ///< there is none
    Draw,    ///< it is drawn, and used
    Use,     ///< it is used
    Compare, ///< it is kept, but all is traced, to see what it saves
    Drop     ///< it is given up, as it does not pay, and all is traced
  };

  /// Called once a frame, before the two below.
  /// @param picturePixels how large the picture is
  Plan plan(Situation situation, glm::ivec2 picturePixels);
  /// What drawing the map took, in frames that are to draw it.
  void mapTook(double milliseconds);
  /// What the light's visibility took, with the map or by tracing all, as planned.
  void visibilityTook(double milliseconds);

  /// Why all is traced in this frame, as a sentence without a full stop; empty where the map is used.
  std::string reason() const;

  /// The most debts that are remembered, in maps: who has the most gets a map after tracing for as long as ten take.
  static constexpr double mostDebtMaps = 9.0;
  /// Frames in which a map is used before it is compared: times of its first ones may be those of cold caches, and
  /// maps that are soon stale are not worth a comparison.
  static constexpr int framesUnquestioned = 16;
  /// Pairs of frames, one traced and the next with the map, that are compared: odd, for a median.
  static constexpr int comparedPairs = 5;
  /// What a map has to save of tracing all to be kept, as a share: times of a few frames do not tell less.
  static constexpr double leastSaving = 0.05;
  /// A map that did not pay is asked for again, though nothing has changed, where tracing takes this many times what
  /// a frame with it took: the camera sees something else.
  static constexpr double lapseOfVerdict = 2.0;

private:
  /// What two neighbouring frames took, the first traced and the second with the map.
  struct Pair
  {
    double traced = 0.0;
    double mapped = 0.0;

    bool pays() const { return this->mapped < (1.0 - leastSaving) * this->traced; }
  };

  void useMap(double milliseconds);
  void payIn(double milliseconds);
  double asked() const;
  bool isToBeCompared() const;
  bool judged() const;
  Pair typicalPair() const;

  Situation situation_ = Situation::Changed;
  Plan plan_ = Plan::Trace;
  std::optional<double> cost_; ///< what the last map took to draw
  double account_ = 0.0;       ///< what maps have saved, less what they cost
  double rent_ = 0.0;   ///< what tracing took in frames in which nothing changed, since a change
  double traced_ = 0.0; ///< what the last frame took that was traced
  Pair known_;          ///< what is known of what the map saves
  int framesInUse_ = 0; ///< of the map that there is
  bool completesPair_ = false;  ///< whether this frame follows one that it is to be compared with
  std::vector<Pair> pairs_;     ///< of its comparison
  std::optional<Pair> dropped_; ///< of a map that was given up, while nothing has changed since
  glm::ivec2 picturePixels_{ 0 };
};

} // namespace gnomon

#endif
