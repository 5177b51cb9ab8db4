# Sentences without a named subject, and phrases that the project's pages and comments avoid.
# Included by TestPages.cmake and TestComments.cmake.

# Beginnings of docstrings and of sentences on pages: nouns that name nothing. Questions may.
set(missing_subject "(Whether|Whoever|Who|What|That which) ")
# The same at the beginning of tests' names: in C++, in Python.
set(test_without_subject "^TEST(_F|_P)?\\([A-Za-z0-9_]+, *(whether|whoever|who|what|thatWhich)[A-Z]"
  "^TEST(_F|_P)?\\([A-Za-z0-9_]+, *(Whether|Whoever|Who|What|ThatWhich)[A-Z]"
  "^[ \t]*def test_(whether|whoever|who|what|that_which)_")
list(JOIN test_without_subject "|" test_without_subject)

set(banned_phrases "all else" "anew" "comes to" "nobody" "that there may be" "that which" "who sets"
  "whoever")
set(banned_on_pages "no longer") # history; in code, bounds are no longer than
set(most_columns 100)
