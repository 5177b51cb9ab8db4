// Invalid shaders: errors that name the shader and the reason, and a library that still works.

#include "EstimatorGlsl.h"

#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <gmock/gmock.h>

namespace gnomon::test
{
namespace
{

using testing::AllOf;
using testing::HasSubstr;

/// Match a call that fails with an error like this.
template <typename Matcher>
auto fails(const Matcher& error)
{
  return testing::ThrowsMessage<ShaderError>(error);
}

using ShaderLibraryTest = GlslTest;

TEST_F(ShaderLibraryTest, saysWhatDoesNotCompileEachTimeThatItIsAskedFor)
{
  ShaderLibrary library;
  const auto broken = [&]
  { ScreenPass::use(library, "out float v;\nvoid main()\n{\n  v = MISSING;\n}\n", { "GIVEN 3" }); };
  for (int attempt = 0; attempt < 2; ++attempt)
  {
    EXPECT_THAT(broken,
      fails(AllOf(HasSubstr("a shader does not compile"), HasSubstr("MISSING"),
        HasSubstr("#define GIVEN 3"))));
  }
  EXPECT_EQ(library.compiles(), 0);
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
  ScreenPass::use(library, "out float v;\nvoid main()\n{\n  v = 1.0;\n}\n");
  EXPECT_EQ(library.compiles(), 1);
}

TEST_F(ShaderLibraryTest, saysWhatDoesNotLink)
{
  ShaderLibrary library;
  const auto broken = [&]
  {
    ScreenPass::use(
      library, "float missing();\nout float v;\nvoid main()\n{\n  v = missing();\n}\n");
  };
  EXPECT_THAT(broken, fails(AllOf(HasSubstr("a program does not link"), HasSubstr("missing"))));
  EXPECT_EQ(library.compiles(), 0);
}

TEST_F(ShaderLibraryTest, namesASourceThatIsNotThere)
{
  EXPECT_THAT([] { ShaderLibrary::source("shadowtech/none.glsl"); },
    fails(HasSubstr("shadowtech/none.glsl")));
}

} // namespace
} // namespace gnomon::test
