# Phrases that the project's pages and comments avoid. Included by TestPages.cmake and
# TestComments.cmake.

# Words that hide the subject, and history.
set(banned_phrases "not any more" "used to" "previously" "formerly" "anew" "whoever" "nobody"
  "somebody" "that which" "all else" "that there may be" "who sets" "comes to" "had been")
# History on a page. In code, sums grow so far and bounds are no longer than.
set(banned_on_pages "no longer" "so far")
set(most_columns 100)
