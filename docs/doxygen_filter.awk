# Doxygen reads <name> in a comment as HTML and * as emphasis; in this project's comments they stand
# for themselves. Code between backquotes stays as it is.
{
  start = index($0, "///")
  if (start == 0) { print; next }
  head = substr($0, 1, start + 2)
  rest = substr($0, start + 3)
  if (substr(rest, 1, 1) == "<") { head = head "<"; rest = substr(rest, 2) }
  parts = split(rest, part, "`")
  for (i = 1; i <= parts; i += 2) {
    gsub(/[<>*]/, "\\\\&", part[i])
  }
  line = part[1]
  for (i = 2; i <= parts; ++i) line = line "`" part[i]
  print head line
}
