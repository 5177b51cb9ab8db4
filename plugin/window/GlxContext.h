#pragma once

namespace gnomon
{

/// Remembers this thread's current context of GLX, or that it has none, and restores a context on
/// destruction. A thread has one of EGL or GLX: while it has one of EGL, GLX ends the process.
class GlxContext
{
public:
  static bool isCurrent();
  /// Leave this thread without a context of GLX, beside which EGL has none.
  static void release();

  GlxContext();
  ~GlxContext();
  GlxContext(const GlxContext&) = delete;
  GlxContext& operator=(const GlxContext&) = delete;

private:
  int (*makeCurrent_)(void*, unsigned long, unsigned long, void*) = nullptr; ///< null: none
  void* display_ = nullptr;
  unsigned long draw_ = 0;
  unsigned long read_ = 0;
  void* context_ = nullptr;
};

} // namespace gnomon
