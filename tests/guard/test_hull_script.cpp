// scripts/hull: what it prints of a mesh is a body that the loader takes and in which the whole
// mesh is. Runs from the root of the project. Proves COL-13.
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

#include "kernel/core/hull.hpp"
#include "kernel/load/number.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

std::string path(const char* suffix) {
  return "/tmp/tactus-hull-" + std::to_string(getpid()) + suffix;
}

/// A random mesh without faces: a cloud on an ellipsoid, round or nearly flat, in mm.
std::vector<Vector3> cloud(Random& random, int count) {
  const Vector3 size = {random.uniform(20.0, 400.0), random.uniform(20.0, 400.0),
                        random.uniform(1.0, 400.0)};
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i) {
    const Vector3 n = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                       random.uniform(-1.0, 1.0)};
    points.emplace_back(size.cwiseProduct(n.normalized()));
  }
  return points;
}

void write_obj(const std::vector<Vector3>& points) {
  std::FILE* file = std::fopen(path(".obj").c_str(), "w");
  assert_non_null(file);
  for (const Vector3& point : points)
    std::fprintf(file, "v %.17g %.17g %.17g\nvn 0 0 1\n", point.x(), point.y(), point.z());
  std::fclose(file);
}

/// Three times each point: the corners of a triangle. The attributes of a binary STL are unused.
void write_stl(const std::vector<Vector3>& points) {
  std::FILE* file = std::fopen(path(".stl").c_str(), "wb");
  assert_non_null(file);
  const char head[80] = "solid, but binary";
  const auto count = static_cast<std::uint32_t>(points.size());
  std::fwrite(head, sizeof head, 1, file);
  std::fwrite(&count, sizeof count, 1, file);
  for (const Vector3& point : points) {
    float numbers[12] = {};
    for (int i = 0; i < 9; ++i) numbers[3 + i] = static_cast<float>(point[i % 3]);
    std::fwrite(numbers, sizeof numbers, 1, file);
    std::fwrite("\0\0", 2, 1, file);
  }
  std::fclose(file);
}

struct Printed {
  Hull hull;
  double rounding = -1.0;
};

/// Reads what the script prints: the points with `point_key`, the rounding with `rounding_key`.
Printed run(const std::string& arguments, const std::string& point_key,
            const std::string& rounding_key) {
  std::FILE* script = popen(("scripts/hull " + arguments).c_str(), "r");
  assert_non_null(script);
  Printed printed;
  char line[256];
  while (std::fgets(line, sizeof line, script) != nullptr) {
    const std::string text(line), key = text.substr(0, text.find_first_of(" ="));
    std::string value = text.substr(text.find('=') + 1, text.size() - text.find('=') - 2);
    if (key == "link_point") {
      assert_int_equal(value.find(" link3 "), 0);
      value.erase(0, 7);
    }
    Message why;
    if (key == point_key) ASSERT_OK(printed.hull.add(value, 1, why));
    if (key == rounding_key) printed.rounding = std::stod(value);
  }
  assert_int_equal(pclose(script), 0);
  return printed;
}

/// The farthest of all points along a direction is no farther than the body.
void assert_inside(const std::vector<Vector3>& points, double unit_m, const Printed& body,
                   Random& random) {
  for (int i = 0; i < 2000; ++i) {
    const Vector3 n =
        Vector3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0))
            .normalized();
    double farthest = -kInfinity;
    for (const Vector3& point : points) farthest = std::max(farthest, unit_m * n.dot(point));
    assert_true(farthest <= n.dot(body.hull.farthest(n)) + body.rounding);
  }
}

// Proves COL-13.

void a_mesh_is_inside_the_body_that_is_printed(void**) {
  Random random{21};
  for (const int count : {5, 60, 400}) {
    const std::vector<Vector3> points = cloud(random, count);
    write_obj(points);
    const Printed body = run(path(".obj") + " --scale 0.001", "point", "rounding");
    assert_int_equal(body.hull.count(), std::min(count, Hull::kMost));
    assert_inside(points, 1e-3, body, random);
    write_stl(points);
    const Printed tool =
        run(path(".stl") + " --scale 0.001 --tool --points 20", "tool_point", "tool_radius");
    assert_int_equal(tool.hull.count(), std::min(count, 20));
    assert_inside(points, 1e-3, tool, random);
    const Printed link = run(path(".stl") + " --scale 0.001 --link link3 --points 20", "link_point",
                             "link_rounding");
    assert_inside(points, 1e-3, link, random);
    assert_true(count > 64 ? body.rounding < tool.rounding : body.rounding <= 2e-5);
  }
  std::remove(path(".obj").c_str());
  std::remove(path(".stl").c_str());
}

void what_is_no_mesh_is_refused(void**) {
  constexpr struct {
    const char *text, *why;
  } kCases[] = {{"v 1 2 x\n", "line 1: 'v 1 2 x' is no point of three numbers"},
                {"v 0 0 0\nv 1 2\n", "line 2: 'v 1 2' is no point"},
                {"v 0 0 0\nv 1e-9 0 0\nv 0 1e-9 0\nv 0 0 1e-9\n", "Is --scale right?"},
                {"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "3 points; a hull needs 4 at least"},
                {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n", "in one plane"},
                {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 nan\n", "not finite"},
                {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 400\n", "Give --scale 0.001"}};
  for (const auto& each : kCases) {
    std::FILE* file = std::fopen(path(".obj").c_str(), "w");
    assert_non_null(file);
    std::fputs(each.text, file);
    std::fclose(file);
    std::FILE* script = popen(("scripts/hull " + path(".obj") + " 2>&1").c_str(), "r");
    assert_non_null(script);
    char said[1024] = "";
    said[std::fread(said, 1, sizeof said - 1, script)] = '\0';
    assert_int_not_equal(pclose(script), 0);
    if (std::strstr(said, each.why) == nullptr) print_error("%s\n", said);
    assert_non_null(std::strstr(said, each.why));
  }
  std::remove(path(".obj").c_str());
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_mesh_is_inside_the_body_that_is_printed),
      cmocka_unit_test(what_is_no_mesh_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
