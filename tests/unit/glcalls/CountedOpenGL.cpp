// Functions with OpenGL's names, which count their calls and jump to OpenGL's own: those that are
// linked, and those that GLEW asks for by name.

#include "CountedOpenGL.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstring>
#include <iterator>

#define GNOMON_FUNCTION(index, name) extern "C" void name();
#include "functions.inc"
#undef GNOMON_FUNCTION

extern "C"
{
  __attribute__((visibility("hidden"))) unsigned long gnomonGlCalls = 0;
  __attribute__((visibility("hidden"))) void* gnomonGlFunctions[GNOMON_FUNCTION_COUNT] = {};
}

#define GNOMON_FUNCTION(index, name)                                                               \
  __asm__(".text\n.globl " #name "\n.type " #name ", @function\n" #name ":\n"                      \
          "  incq gnomonGlCalls(%rip)\n"                                                           \
          "  jmp *gnomonGlFunctions+8*" #index "(%rip)\n");
#include "functions.inc"
#undef GNOMON_FUNCTION

namespace
{

struct Counted
{
  const char* name;
  void (*function)();
};

#define GNOMON_FUNCTION(index, name) { #name, name },
const Counted counted[] = {
#include "functions.inc"
};
#undef GNOMON_FUNCTION

__attribute__((constructor)) void findFunctions()
{
  void* const library = dlopen(GNOMON_OPENGL, RTLD_NOW | RTLD_LOCAL);
  for (std::size_t i = 0; i < std::size(counted); ++i)
  {
    gnomonGlFunctions[i] = dlsym(library, counted[i].name);
  }
}

using Lookup = void* (*)(const char*);

/// Return the function that counts, or what another function finds.
void* find(const char* name, const char* lookup)
{
  const Counted* const place = std::lower_bound(std::begin(counted), std::end(counted), name,
    [](const Counted& function, const char* wanted)
    { return std::strcmp(function.name, wanted) < 0; });
  if (place != std::end(counted) && std::strcmp(place->name, name) == 0)
  {
    return reinterpret_cast<void*>(place->function);
  }
  const auto other = reinterpret_cast<Lookup>(dlsym(RTLD_NEXT, lookup));
  return other ? other(name) : nullptr;
}

} // namespace

extern "C" void* glXGetProcAddressARB(const char* name)
{
  return find(name, "glXGetProcAddressARB");
}

extern "C" void* glXGetProcAddress(const char* name)
{
  return find(name, "glXGetProcAddress");
}

extern "C" void* eglGetProcAddress(const char* name)
{
  return find(name, "eglGetProcAddress");
}

unsigned long gnomonCountOfGlCalls()
{
  return gnomonGlCalls;
}
