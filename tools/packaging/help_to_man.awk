# One --help of CLI11 as part of a manual page. Names of options stand in columns 3 to 30; a longer name has its
# description on the next line, below column 31.

function escaped(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  if (text ~ /^[.']/) text = "\\&" text
  return text
}

function trimmed(text) {
  gsub(/^ +| +$/, "", text)
  return text
}

function entry(i,    long_name, term) {
  long_name = i < NR && substr(line[i + 1], 1, 30) == sprintf("%30s", "")
  term = trimmed(long_name ? line[i] : substr(line[i], 1, 30))
  if (term ~ /^--(workers|threads) /) sub(/=[0-9]+$/, "", term)  # of the machine that makes the page
  print ".TP\n.B " escaped(term)
  print escaped(trimmed(long_name ? line[i + 1] : substr(line[i], 31)))
}

function first_sentence(text) {
  sub(/\. .*/, "", text)
  sub(/\.$/, "", text)
  return tolower(substr(text, 1, 1)) substr(text, 2)
}

{ line[NR] = $0 }

END {
  usage = line[2]
  sub(/^Usage: /, "", usage)
  if (level == "page") {
    print ".SH NAME\n" escaped(name) " \\- " escaped(first_sentence(line[1]))
    print ".SH SYNOPSIS\n.B " escaped(usage)
    print ".SH DESCRIPTION\n" escaped(line[1])
  } else {
    print ".SH " toupper(name " " subcommand) "\n.B " escaped(usage) "\n.PP\n" escaped(line[1]) "."
  }
  for (i = 3; i <= NR; ++i) {
    if (line[i] ~ /^[A-Z][A-Za-z ]*:$/) {
      heading = substr(line[i], 1, length(line[i]) - 1)
      if (level == "page") print ".SH " toupper(heading == "Subcommands" ? "Commands" : heading)
      else print ".SS " heading
    } else if (line[i] ~ /^  [^ ]/) {
      entry(i)
    }
  }
}
