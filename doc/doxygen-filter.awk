# Markdown as written for reading on the web -> what doxygen understands:
# $$ lines and $...$ to \f[ \f] and \f$, [key2000] to \cite key2000.
/^\$\$$/ { open = !open; print open ? "\\f[" : "\\f]"; next }
!open {
  gsub(/\$/, "\\f$")
  while (match($0, /\[[a-z]+[0-9][0-9]([0-9][0-9])?\]/))
    $0 = substr($0, 1, RSTART - 1) "\\cite " substr($0, RSTART + 1, RLENGTH - 2) substr($0, RSTART + RLENGTH)
}
{ print }
