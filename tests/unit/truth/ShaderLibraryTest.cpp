// Invalid shaders: errors that name the shader and the reason, and a library that still works.

#include "EstimatorGlsl.h"

#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <gmock/gmock.h>

#include <functional>
#include <string>

namespace gnomon::test
{
namespace
{

using testing::AllOf;
using testing::HasSubstr;

/// Return the error of a call that has to fail.
std::string errorOf(const std::function<void()>& call)
{
  try
  {
    call();
  }
  catch (const ShaderError& error)
  {
    return error.what();
  }
  return "no error";
}

using ShaderLibraryTest = GlslTest;

TEST_F(ShaderLibraryTest, saysWhatDoesNotCompileEachTimeThatItIsAskedFor)
{
  ShaderLibrary library;
  const auto broken = [&]
  { ScreenPass::use(library, "out float v;\nvoid main()\n{\n  v = MISSING;\n}\n", { "GIVEN 3" }); };
  for (int attempt = 0; attempt < 2; ++attempt)
  {
    EXPECT_THAT(errorOf(broken),
      AllOf(HasSubstr("a shader does not compile"), HasSubstr("MISSING"),
        HasSubstr("#define GIVEN 3")));
  }
  EXPECT_EQ(library.compiles(), 0);
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
  ScreenPass::use(library, "out float v;\nvoid main()\n{\n  v = 1.0;\n}\n");
  EXPECT_EQ(library.compiles(), 1);
}

TEST_F(ShaderLibraryTest, saysWhatDoesNotLink)
{
  ShaderLibrary library;
  EXPECT_THAT(errorOf(
                [&]
                {
                  ScreenPass::use(library,
                    "float missing();\nout float v;\nvoid main()\n{\n  v = missing();\n}\n");
                }),
    AllOf(HasSubstr("a program does not link"), HasSubstr("missing")));
  EXPECT_EQ(library.compiles(), 0);
}

TEST_F(ShaderLibraryTest, namesASourceThatIsNotThere)
{
  EXPECT_THAT(errorOf([] { ShaderLibrary::source("shadowtech/none.glsl"); }),
    HasSubstr("shadowtech/none.glsl"));
}

} // namespace
} // namespace gnomon::test
