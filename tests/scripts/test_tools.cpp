// Tests that the checking tools can fail: each gets a planted violation. Runs from the root of the
// project.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <initializer_list>

#include "tests/support/testing.hpp"

namespace {

/// Writes `text` to `path` below a fresh scratch folder, whose name is left in `folder`.
void plant(const char* path, const char* text, char (&folder)[64]) {
  std::snprintf(folder, sizeof folder, "/tmp/tactus-tools-%d-XXXXXX", static_cast<int>(getpid()));
  assert_non_null(mkdtemp(folder));
  char command[512], file[256];
  std::snprintf(file, sizeof file, "%s/%s", folder, path);
  std::snprintf(command, sizeof command, "mkdir -p $(dirname %s)", file);
  assert_int_equal(std::system(command), 0);
  std::FILE* stream = std::fopen(file, "w");
  assert_non_null(stream);
  std::fputs(text, stream);
  std::fclose(stream);
}

/// Runs a command in which %s stands for `folder`; true if it ended with exit code 0.
[[gnu::format(printf, 1, 0)]] bool passes(const char* command, const char* folder) {
  char text[1024];
  std::snprintf(text, sizeof text, command, folder);
  return std::system(text) == 0;
}

/// Whether scripts/layers reports a tree with one file.
void layers_refuse(const char* path, const char* text) {
  char folder[64];
  plant(path, text, folder);
  if (!passes("scripts/layers %s 2>/dev/null", folder)) return;
  print_error("%s: %s passes\n", path, text);
  _fail(__FILE__, __LINE__);
}

int remove_planted(void**) {
  char command[64];
  std::snprintf(command, sizeof command, "rm -r /tmp/tactus-tools-%d-*",
                static_cast<int>(getpid()));
  return std::system(command);
}

// Proves KER-2.

void the_tree_keeps_its_layers(void**) {
  assert_int_equal(std::system("scripts/layers"), 0);
}

void an_include_across_the_layers_is_found(void**) {
  const char* violations[][2] = {
      {"kernel/control/law.hpp", "#include \"hal/can/socketcan.hpp\"\n"},
      {"kernel/control/law.hpp", "#include <vector>\n"},
      {"kernel/control/law.hpp", "#include <sys/socket.h>\n"},
      {"kernel/control/law.hpp", "#include \"kernel/control/pd_gravity.hpp\"\n"},
      {"kernel/math/x.hpp", "#include \"tests/support/testing.hpp\"\n"},
      {"sim_plant/arm/arm.hpp", "#include \"kernel/pipeline/pipeline.hpp\"\n"},
      {"gateway/server.hpp", "#include \"program/session/session.hpp\"\n"},
      {"hal/ur/x.hpp", "#include \"sim_plant/arm/arm.hpp\"\n"},
  };
  for (const auto& [path, text] : violations) layers_refuse(path, text);
}

void an_include_is_found_in_a_source_of_every_suffix(void**) {
  for (const char* path : {"kernel/core/x.h", "kernel/core/x.c", "kernel/core/x.cc",
                           "kernel/core/x.inl", "kernel/core/x.ipp"})
    layers_refuse(path, "#include <mutex>\n");
}

void an_include_is_found_however_it_is_written(void**) {
  for (const char* text : {
           "/* x */ #include <mutex>\n",
           "/*\n*/ #include <mutex>\n",
           "#/**/include <mutex>\n",
           "# /*\n*/ include <mutex>\n",
           "#include /* x */ <mutex>\n",
           "#  include<mutex>\n",
           "#inc\\\nlude <mutex>\n",
           "#include \\\n<mutex>\n",
           "%:include <mutex>\n",
           "\xef\xbb\xbf#include <mutex>\n",
           "const char* a = \"/*\";\n#include <mutex>\nconst char* b = \"*/\";\n",
           "const char* a = R\"x(\")x\" \"/*\";\n#include <mutex>\n/* */\n",
           "int a = 1'0; /* ' */\n#include <mutex>\n",
       })
    layers_refuse("kernel/core/x.hpp", text);
}

void an_include_that_cannot_be_read_is_refused(void**) {
  const char* violations[][2] = {
      {"kernel/core/x.hpp", "#define HEADER <array>\n#include HEADER\n"},
      {"kernel/core/x.hpp", "#include_next <array>\n"},
      {"kernel/core/x.hpp", "#import <array>\n"},
      {"kernel/core/x.hpp", "#include /*\n*/ <array>\n"},
      {"kernel/core/x.hpp", "#include \"kernel/../hal/x.hpp\"\n"},
      {"gateway/x.hpp", "#include <./hal/x.hpp>\n"},
      {"kernel/core/x.hpp", "// \xff\n"},
      {"folder_without_a_rule/x.hpp", "\n"},
      {"x.hpp", "\n"},
      {"kernel/README.md", "no source at all\n"},
  };
  for (const auto& [path, text] : violations) layers_refuse(path, text);
}

void what_is_included_is_a_source_and_no_link(void**) {
  char folder[64];
  plant("kernel/core/x.hpp", "#include \"kernel/core/table.def\"\n", folder);
  assert_true(passes("scripts/layers %s", folder));
  assert_true(passes("touch %s/kernel/core/table.def", folder));
  assert_false(passes("scripts/layers %s 2>/dev/null", folder));
  plant("kernel/core/x.hpp", "#include \"kernel/core/y.hpp\"\n", folder);
  assert_true(passes("ln -s /dev/null %s/kernel/core/y.hpp", folder));
  assert_false(passes("scripts/layers %s 2>/dev/null", folder));
}

void an_allowed_include_is_not_complained_of(void**) {
  char folder[64];
  plant("kernel/control/law.hpp", "#include <array>\n#include \"kernel/core/port.hpp\"\n", folder);
  assert_true(passes("scripts/layers %s", folder));
  plant("kernel/core/x.hpp",
        "// #include <mutex>\n/*\n#include <mutex>\n*/\n#include <array>  // why\n"
        "const char* a = R\"x(\n#include <mutex>\n)\")x\";\nint b = 1'000'000;\n",
        folder);
  assert_true(passes("scripts/layers %s", folder));
}

// Proves KER-1.

void a_heap_call_in_an_archive_is_found(void**) {
  const char* violations[] = {
      "#include <vector>\nint f(int n) { std::vector<int> v; v.push_back(n); return v[0]; }\n",
      "#include <cstdlib>\nvoid* f() { return std::malloc(8); }\n",
      "void f() { throw 1; }\n",
      "#include <cstdio>\nvoid f() { std::puts(\"\"); }\n",
      "#include <ctime>\nlong f() { return std::time(nullptr); }\n",
      "#include <cmath>\ndouble f(double x) { return std::sin(x); }\n",
      "extern \"C\" [[gnu::weak]] void* malloc(decltype(sizeof 0));\n"
      "void* f() { return malloc ? malloc(8) : nullptr; }\n",
      "extern \"C\" void __aeabi_atexit();\nvoid f() { __aeabi_atexit(); }\n",
  };
  for (const char* text : violations) {
    char folder[64];
    plant("x.cpp", text, folder);
    assert_true(passes("cd %s && g++ -O3 -c x.cpp && ar rcs x.a x.o", folder));
    assert_false(passes("scripts/no_heap %s/x.a 2>/dev/null", folder));
  }
}

void a_heap_call_is_found_among_any_number_of_names(void**) {
  char folder[64];
  plant("x.c", "#include <stdlib.h>\nvoid* f(void) { return malloc(8); }\n", folder);
  assert_true(
      passes("cd %s && seq -f 'void a_name_of_forty_characters_%%012.0f(void) {}' 4000 >> x.c &&"
             " gcc -c x.c && ar rcs x.a x.o",
             folder));
  assert_false(passes("scripts/no_heap %s/x.a 2>/dev/null", folder));
}

/// Whether the report of scripts/no_heap on a file in the folder has the reason and the remedy.
void refused(const char* folder, const char* file, const char* reason) {
  char command[512];
  std::snprintf(
      command, sizeof command,
      "! scripts/no_heap %s/%s 2> %s/said && grep -q '%s: .*%s.*; build it again' %s/said", folder,
      file, folder, file, reason, folder);
  assert_int_equal(std::system(command), 0);
}

void an_archive_that_cannot_be_read_is_refused_with_reason_and_remedy(void**) {
  char folder[64];
  plant("x.cpp", "int f() { return 0; }\n", folder);
  assert_true(
      passes("cd %s && ar rcs empty.a && ar rcs text.a x.cpp && g++ -c x.cpp && strip x.o &&"
             " ar rcs stripped.a x.o",
             folder));
  refused(folder, "missing.a", "not a file");
  refused(folder, ".", "not a file");
  refused(folder, "x.cpp", "not an archive");
  refused(folder, "x.o", "not an archive");
  refused(folder, "empty.a", "defines nothing");
  refused(folder, "text.a", "x.cpp: file format not recognized");
  refused(folder, "stripped.a", "x.o: no symbols");
  assert_false(passes("scripts/no_heap %s/text.a missing-nm 2>/dev/null", folder));
}

void a_pure_archive_is_not_complained_of(void**) {
  char folder[64];
  plant("x.cpp", "#include <cmath>\ndouble f(double x) { return std::sqrt(x * x + 1); }\n", folder);
  assert_true(passes("cd %s && g++ -O3 -c x.cpp && ar rcs x.a x.o", folder));
  assert_true(passes("scripts/no_heap %s/x.a", folder));
}

/// By its whole name.
void only_symbols_that_are_named_are_allowed_in_addition(void**) {
  char folder[64];
  plant("x.cpp", "#include <unistd.h>\nint f() { return close(3); }\n", folder);
  assert_true(passes("cd %s && g++ -O3 -c x.cpp && ar rcs x.a x.o", folder));
  assert_false(passes("scripts/no_heap %s/x.a 2>/dev/null", folder));
  assert_false(passes("scripts/no_heap %s/x.a nm 'closed|clos' 2>/dev/null", folder));
  assert_true(passes("scripts/no_heap %s/x.a nm 'poll|close'", folder));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_tree_keeps_its_layers),
      cmocka_unit_test(an_include_across_the_layers_is_found),
      cmocka_unit_test(an_include_is_found_in_a_source_of_every_suffix),
      cmocka_unit_test(an_include_is_found_however_it_is_written),
      cmocka_unit_test(an_include_that_cannot_be_read_is_refused),
      cmocka_unit_test(what_is_included_is_a_source_and_no_link),
      cmocka_unit_test(an_allowed_include_is_not_complained_of),
      cmocka_unit_test(a_heap_call_in_an_archive_is_found),
      cmocka_unit_test(a_heap_call_is_found_among_any_number_of_names),
      cmocka_unit_test(an_archive_that_cannot_be_read_is_refused_with_reason_and_remedy),
      cmocka_unit_test(a_pure_archive_is_not_complained_of),
      cmocka_unit_test(only_symbols_that_are_named_are_allowed_in_addition),
  };
  return cmocka_run_group_tests(tests, nullptr, remove_planted);
}
