# Phrases that the project's pages and comments avoid: history, and words that hide the subject.
# Included by TestPages.cmake and TestComments.cmake.
set(banned_phrases "no longer" "not any more" "used to" "previously" "formerly" "so far"
  "anew" "whoever" "nobody" "somebody" "that which" "all else" "that there may be" "who sets"
  "comes to" "had been")
set(most_columns 100)
