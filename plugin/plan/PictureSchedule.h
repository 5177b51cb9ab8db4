#pragma once

#include <optional>

namespace gnomon
{

/// The share of the picture asked for that a frame shows.
struct ShownPicture
{
  bool moves = false;         ///< true if it is one of a moving picture (PictureSchedule::moves())
  bool isApproximate = false; ///< true if it moves, and a picture at rest may differ from it
  double progress = 1.0;      ///< share of its lights' points, in [0, 1]; later frames add the rest
};

/// An order to the owner of a timer.
struct TimerOrder
{
  enum class Kind
  {
    None,
    Start, ///< a one-shot timer
    Stop,  ///< the timer that waits
    Draw   ///< the picture that is due, at rest
  };
  Kind kind = Kind::None;
  int milliseconds = 0; ///< duration of a timer to start
};

/// Decides which frames are moving pictures, and when a further picture is due. It holds times and
/// flags alone. At most one timer waits, and none while the user holds a button or an interactor
/// style acts: styles repeat their last motion at each TimerEvent, and end with a frame at rest.
///
/// Times (`now`) are milliseconds since a fixed moment.
class PictureSchedule
{
public:
  static constexpr double patience = 500.0; ///< a picture unchanged for this long is at rest

  /// Note a change of camera, lights or props. Call before a frame that its window asks to be fast.
  /// @return true if the frame moves: the scene changed less than `patience` ago
  bool moves(bool changed, double now);

  /// True if more frames follow one at rest, so that this one may be unfinished: it follows a
  /// moving frame, or a timer draws it. Frames that a program draws by itself are complete.
  bool mayRefine() const
  {
    return (this->wasApproximate_ || this->isDrawing_) && this->stalls_ == 0 && !this->isHeld_;
  }

  /// Order a timer for the frame after one at rest.
  TimerOrder refine(double now);

  /// Note a drawn frame.
  /// @param acts true while an interactor style acts
  TimerOrder drawn(const ShownPicture& picture, bool acts, double now);

  ///@{
  /// Note that the user presses or releases a mouse button.
  TimerOrder pressed();
  TimerOrder released(double now);
  ///@}

  /// Note that an interaction starts.
  TimerOrder interacts();

  /// Note that the timer that waits has fired.
  void fired() { this->firesAt_.reset(); }
  /// Note that no timer waits, as none could be started.
  void failed() { this->firesAt_.reset(); }

  /// Note a TimerEvent, of any timer.
  TimerOrder timerEvent(bool acts, double now);
  /// Note that an order to draw led to no frame.
  void notDrawn() { this->isDrawing_ = false; }

private:
  TimerOrder order(bool acts, double now);

  double changedAt_ = 0.0;
  std::optional<double> dueAt_;   ///< none: the picture is finished
  std::optional<double> firesAt_; ///< when the timer that waits should fire
  bool wasApproximate_ = false;   ///< true if the last frame was
  double progress_ = 1.0;         ///< of the last frame
  int stalls_ = 0;                ///< frames that the timer drew in a row without progress
  bool isDrawing_ = false;        ///< true while the timer draws a frame
  bool isHeld_ = false;           ///< true while a button is held
};

} // namespace gnomon
