// gnomon_check SCENE.json VISIBILITY.exr: check whether a visibility file is true.
//
// Compares it with its own rays, and prints where tolerances are exceeded. Exit code 0: true within
// the tolerances, 1: not, 2: bad input.

#include "Check.h"

#include <exception>
#include <iostream>

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: gnomon_check SCENE.json VISIBILITY.exr\n";
    return 2;
  }
  try
  {
    const gnomon::check::VisibilityFile file = gnomon::check::readVisibilityFile(argv[2]);
    const gnomon::check::Scene scene = gnomon::check::readScene(argv[1]);
    const gnomon::check::Result result = gnomon::check::compare(scene, file);
    for (const std::string& failure : result.failures(file.width))
    {
      std::cerr << "gnomon_check: " << failure << "\n";
    }
    return result.failures().empty() ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::cerr << "gnomon_check: error: " << error.what() << "\n";
    return 2;
  }
}
