# Reads every .lcm file and writes to OUT, for each type, what lcm-gen's decoders do not check: how its members lie on the wire, which member
# counts which array, and a visitor of its members; and the list of all types. The layout is defined in libs/bus/wire_shape.hpp.
#   awk -v OUT=message_types.hpp -f message_types.awk *.lcm
function fail(text) { printf "%s:%d: %s\n", FILENAME, FNR, text > "/dev/stderr"; failed = 1; exit 1 }
BEGIN {
  bytes["int8_t"] = bytes["byte"] = bytes["boolean"] = 1; bytes["int16_t"] = 2
  bytes["int32_t"] = bytes["float"] = 4; bytes["int64_t"] = bytes["double"] = 8
}
{ sub(/\/\/.*/, ""); gsub(/;/, " ; "); gsub(/[{}]/, " & ") }
/^[ \t]*package/ || /^[ \t]*const/ || NF == 0 { next }
/^[ \t]*struct/ { type = $2; types[++type_count] = type; next }
$1 == "}" { type = ""; next }
$1 == "{" { next }
{
  if (type == "" || $3 != ";" || NF != 3) fail("one member a line: `type name;` or `type name[size];`")
  n = ++members[type]; kind[type, n] = $1; name[type, n] = $2; size[type, n] = ""
  if (match($2, /\[[A-Za-z0-9_]+\]$/)) {
    name[type, n] = substr($2, 1, RSTART - 1)
    size[type, n] = substr($2, RSTART + 1, RLENGTH - 2)
    if (size[type, n] !~ /^[0-9]+$/) counts[type, size[type, n]] = 1
  }
}
# The layout of a type: numbers of bytes are added up in `run` until something of variable size follows.
function emit(text) { layout = layout (run > 0 ? " " run : "") (text != "" ? " " text : ""); run = 0 }
function layoutOf(type,   saved_layout, saved_run, result) {
  saved_layout = layout; saved_run = run; layout = ""; run = 0
  append(type); emit(""); result = substr(layout, 2)
  layout = saved_layout; run = saved_run
  return result
}
function append(type,   i, j, k, each) {
  for (i = 1; i <= members[type]; i++) {
    k = kind[type, i]
    if ((type, name[type, i]) in counts) {
      each = 0; group = ""
      for (j = i + 1; j <= members[type] && size[type, j] == name[type, i]; j++) {
        if (kind[type, j] in bytes) each += bytes[kind[type, j]]
        else group = layoutOf(kind[type, j])
      }
      if (j == i + 1) { printf "%s.%s: its arrays must follow it directly\n", type, name[type, i] > "/dev/stderr"; failed = 1; exit 1 }
      if (group ~ /^[0-9]+$/) { each += group; group = "" }
      emit(group == "" ? "#*" each : "#(" group ")")
      i = j - 1
    } else if (k == "string") emit("s")
    else if (k in bytes) run += bytes[k] * (size[type, i] == "" ? 1 : size[type, i])
    else append(k)
  }
}
function agreement(type,   i, j, test, arrays, text) {
  text = ""
  for (i = 1; i <= members[type]; i++) {
    if ((type, name[type, i]) in counts) {
      arrays = ""
      for (j = i + 1; j <= members[type]; j++) if (size[type, j] == name[type, i]) arrays = arrays ", m." name[type, j]
      text = text " && countFits(m." name[type, i] arrays ")"
    } else if (!(kind[type, i] in bytes) && kind[type, i] != "string")
      text = text " && " (size[type, i] == "" ? "countsAgreeIn" : "countsAgreeInEach") "(m." name[type, i] ")"
  }
  return text == "" ? "true" : substr(text, 5)
}
function visit(type, i,   m, s, k) {
  m = "m." name[type, i]; s = size[type, i]; k = kind[type, i]
  if ((type, name[type, i]) in counts) return "visitor.count(" m ");"
  if (s == "" && (k in bytes || k == "string")) return "visitor.value(" m ");"
  if (s == "") return "WireShape<" k ">::visit(" m ", visitor);"
  if (s ~ /^[0-9]+$/) return "for (auto& value : " m ") visitor.value(value);"
  return "visitor.resize(" m ", m." s "); for (auto& value : " m ") " (k in bytes ? "visitor.value(value);" : "WireShape<" k ">::visit(value, visitor);")
}
END {
  if (failed) exit 1
  print "// Made by lcmtypes/message_types.awk from lcmtypes/*.lcm.\n#pragma once\n" > OUT
  for (t = 1; t <= type_count; t++) print "#include \"redbee/" types[t] ".hpp\"" > OUT
  print "#include \"redbee/bus/wire_shape.hpp\"\n\nnamespace redbee {\n" > OUT
  # A nested type's shape stands before the shapes that use it.
  for (pass = 0; written < type_count && pass <= type_count; pass++) for (t = 1; t <= type_count; t++) {
    type = types[t]
    if (type in done) continue
    ready = 1
    for (i = 1; i <= members[type]; i++) if (!(kind[type, i] in bytes) && kind[type, i] != "string" && !(kind[type, i] in done)) ready = 0
    if (!ready) continue
    done[type] = 1; written++
    printf "template <>\nstruct WireShape<%s> {\n  static constexpr std::string_view kLayout = \"%s\";\n", type, layoutOf(type) > OUT
    printf "  static bool countsAgree([[maybe_unused]] const %s& m) { return %s; }\n", type, agreement(type) > OUT
    print "  template <typename Message, typename Visitor>\n  static void visit(Message& m, Visitor& visitor) {" > OUT
    for (i = 1; i <= members[type]; i++) print "    " visit(type, i) > OUT
    print "  }\n};\n" > OUT
  }
  if (written < type_count) { print "message_types.awk: a member's type is no type of lcmtypes/" > "/dev/stderr"; exit 1 }
  printf "using MessageTypes = TypeList<" > OUT
  for (t = 1; t <= type_count; t++) printf "%s%s", (t > 1 ? ", " : ""), types[t] > OUT
  print ">;\n\n}  // namespace redbee" > OUT
}
