# Sentences without a named subject, and phrases that the project's pages and comments avoid.
# Included by TestPages.cmake and TestComments.cmake.

# Beginnings of docstrings and of sentences on pages: nouns that name nothing. Questions may.
set(missing_subject "(Whether|Whoever|Who|What|That which) ")

set(banned_phrases "all else" "anew" "comes to" "nobody" "that there may be" "that which" "who sets"
  "whoever")
set(banned_on_pages "no longer") # history; in code, bounds are no longer than
set(most_columns 100)
