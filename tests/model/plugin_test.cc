// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "model/blade_plugin.h"
#include "model/export.h"
#include "tests/installed_program.h"
#include "tests/model/blade_file_complaint.h"
#include "tests/model/test_blades.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

struct CloseLibrary {
  void operator()(void* library) const { dlclose(library); }
};
using Library = std::unique_ptr<void, CloseLibrary>;

fs::path Scratch(const std::string& name) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const fs::path folder = fs::path(testing::TempDir()) / ("plugin_test." + test);
  fs::create_directories(folder);
  return folder / name;
}

void WriteText(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

Library Open(const fs::path& path) {
  Library library(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL));
  EXPECT_TRUE(library) << dlerror();
  return library;
}

const bladecurve_plugin& TableOf(const Library& library) {
  return *static_cast<const bladecurve_plugin*>(dlsym(library.get(), "bladecurve_entry"));
}

template <typename Function>
Function* FunctionOf(const Library& library, const char* name) {
  return reinterpret_cast<Function*>(dlsym(library.get(), name));
}

CurveSample FromPlugin(const bladecurve_plugin& table, double x, double theta) {
  bladecurve_sample s;
  table.eval(x, theta, &s);
  return {s.phi_mm,
          s.phi_x,
          s.phi_theta_mm_per_rad,
          s.phi_xx_per_mm,
          s.phi_xtheta_per_rad,
          s.phi_thetatheta_mm_per_rad2,
          s.flags};
}

BladeFile SplineBlade(int degree, int num_spans) {
  std::mt19937 random(static_cast<unsigned>(10 * degree + num_spans));
  return {"spline", {RandomSpline(random, degree, num_spans, 0.5), {15, 105, 0.05, 0.9}}};
}

BladeFile TaperedBlade() { return {"small", {TaperedRectangle{-11, 0.14, 0.5}, {20, 100, 0, 1}}}; }

// Overhangs when it is opened wide.
BladeFile HookBlade() {
  return {"hook", {RigidSpline{2, {0, 0, 0, 100, 100, 100}, {0, 0, 150}}, {-50, 100, 0, 1.5}}};
}

// Inside, outside, at the borders, and not finite.
void ExpectSameBits(const bladecurve_plugin& table,
                    const BladeCurve& curve,
                    const std::string& by) {
  std::mt19937 random(1);
  const CurveDomain& d = curve.domain();
  for (int i = 0; i < 3000; ++i) {
    const double x = i % 50 ? Uniform(random, d.x_min_mm - 5, d.x_max_mm + 5) : d.x_max_mm;
    const double theta =
        i % 70 ? Uniform(random, -0.2, 1.6) : std::numeric_limits<double>::infinity();
    const CurveSample own = curve.Eval(x, theta);
    EXPECT_TRUE(SameBits(own, FromPlugin(table, x, theta))) << by << ": " << x << " " << theta;
    std::array<double, 16> here = {}, there = {};
    const int count = curve.Contacts(own.phi_mm, theta, here);
    EXPECT_EQ(table.contacts(own.phi_mm, theta, there.data(), 16), count) << by;
    EXPECT_EQ(std::memcmp(here.data(), there.data(), sizeof(here)), 0) << by;
  }
}

struct Compiler {
  const char* program;
  const char* flags;
};

constexpr const char* kC = "-std=c99 -pedantic -Wall -Wextra -Wconversion -Werror";
constexpr const char* kCxx =
    "-x c++ -std=c++11 -pedantic -Wall -Wextra -Wconversion -Wshadow -Wold-style-cast -Werror";

// Compiles with a name of its own for each library: the loader keeps one that it has seen.
fs::path BuildBy(const Compiler& compiler, const std::string& level, const BladeFile& blade) {
  static int count = 0;
  const fs::path built = Scratch(std::to_string(++count) + ".so");
  WriteText(Scratch("blade.c"), PluginSource(blade));
  const std::string command = std::string(compiler.program) + " " + compiler.flags + " " + level +
                              " -ffp-contract=off -fPIC -shared " + Scratch("blade.c").string() +
                              " -o " + built.string() + " -lm > " + Scratch("log").string() +
                              " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  EXPECT_EQ(fs::file_size(Scratch("log")), 0u) << "warnings of " << command;
  return built;
}

class EveryCompiler : public testing::TestWithParam<Compiler> {};

TEST_P(EveryCompiler, TakesTheSourceWithoutAWarningAndGivesTheLibrarysBits) {
  const Compiler compiler = GetParam();
  if (!IsInstalled(compiler.program)) GTEST_SKIP() << compiler.program << " is not installed";
  for (const BladeFile& blade :
       {TaperedBlade(), SplineBlade(3, 6), SplineBlade(5, 1), HookBlade()}) {
    for (const std::string level : {"-O0", "-O3"}) {
      const Library library = Open(BuildBy(compiler, level, blade));
      ExpectSameBits(TableOf(library), blade.curve, compiler.program + level + blade.name);
    }
  }
}

std::string CompilerName(const testing::TestParamInfo<Compiler>& param) {
  std::string name = param.param.program;
  for (char& c : name) c = c == '+' ? 'p' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Compilers,
                         EveryCompiler,
                         testing::Values(Compiler{"gcc", kC},
                                         Compiler{"clang", kC},
                                         Compiler{"tcc", kC},
                                         Compiler{"g++", kCxx},
                                         Compiler{"clang++", kCxx}),
                         CompilerName);

TEST(Plugin, NeedsMathHAlone) {
  const std::string source = PluginSource(SplineBlade(3, 4));
  for (std::size_t at = source.find("#include"); at != std::string::npos;
       at = source.find("#include", at + 1)) {
    EXPECT_EQ(source.substr(at, 17), "#include <math.h>");
  }
}

class BuiltPlugin : public testing::Test {
 protected:
  void SetUp() override {
    if (!IsInstalled("cc")) GTEST_SKIP() << "no C compiler";
  }
  fs::path Build(const std::string& source) const {
    static int count = 0;
    const fs::path path = Scratch("built" + std::to_string(++count) + ".so");
    CompilePlugin(source, path);
    return path;
  }
};

TEST_F(BuiltPlugin, ReadsBackAsTheSameBlade) {
  for (BladeFile blade : {TaperedBlade(), SplineBlade(1, 1), SplineBlade(4, 6), HookBlade()}) {
    blade.name =
        "quote \" back \\ tri ?"
        "?/ \xc3\xa9 */";
    blade.fit_rms_mm = 0.0125;
    blade.source_sha256 = std::string(64, 'a');
    blade.standard_errors.assign(ParameterValues(blade.curve.shape()).size(), 0.5);
    blade.standard_errors.back() = std::numeric_limits<double>::quiet_NaN();
    const BladeFile again = ReadBladeFile(Build(PluginSource(blade)));
    EXPECT_EQ(BladeFileText(again), BladeFileText(blade));
    EXPECT_EQ(again.source_sha256, blade.source_sha256);
    EXPECT_EQ(PluginSource(again), PluginSource(blade));
    EXPECT_TRUE(SameBits(again.curve.Eval(50, 0.4), blade.curve.Eval(50, 0.4)));
  }
}

TEST_F(BuiltPlugin, FlatFunctionsSayWhatTheTableSays) {
  BladeFile blade = TaperedBlade();
  blade.standard_errors = {0.1, 0.2, -1};
  const Library library = Open(Build(PluginSource(blade)));
  const bladecurve_plugin& table = TableOf(library);
  EXPECT_EQ(table.version, BLADECURVE_PLUGIN_VERSION);
  EXPECT_EQ(table.size, sizeof(bladecurve_plugin));
  EXPECT_EQ(FunctionOf<unsigned()>(library, "bladecurve_version")(), table.version);
  EXPECT_STREQ(FunctionOf<const char*()>(library, "bladecurve_id")(), "small");
  EXPECT_STREQ(FunctionOf<const char*()>(library, "bladecurve_units")(), "mm,rad");
  EXPECT_STREQ(FunctionOf<const char*()>(library, "bladecurve_family")(), "tapered-rectangle");
  EXPECT_STREQ(FunctionOf<const char*()>(library, "bladecurve_source_sha256")(), "");
  EXPECT_EQ(FunctionOf<double()>(library, "bladecurve_fit_rms_mm")(), -1);
  EXPECT_EQ(FunctionOf<int()>(library, "bladecurve_num_parameters")(), 3);
  const auto name = FunctionOf<const char*(int)>(library, "bladecurve_parameter_name");
  const auto value = FunctionOf<double(int)>(library, "bladecurve_parameter");
  const auto error = FunctionOf<double(int)>(library, "bladecurve_standard_error");
  EXPECT_STREQ(name(1), "b");
  EXPECT_EQ(value(1), 0.14);
  EXPECT_EQ(error(1), 0.2);
  EXPECT_EQ(error(2), -1);
  EXPECT_STREQ(name(3), "");
  EXPECT_EQ(value(-1), 0);
  std::array<double, 4> d;
  FunctionOf<void(double*, double*, double*, double*)>(library, "bladecurve_domain")(
      &d[0], &d[1], &d[2], &d[3]);
  EXPECT_EQ(d, (std::array<double, 4>{20, 100, 0, 1}));
}

TEST_F(BuiltPlugin, EvalNIsEvalManyTimes) {
  const BladeFile blade = SplineBlade(3, 4);
  const Library library = Open(Build(PluginSource(blade)));
  const bladecurve_plugin& table = TableOf(library);
  constexpr std::array<double, 3> kX = {20, 50, 200};
  constexpr std::array<double, 3> kTheta = {0.1, 0.5, 0.7};
  std::array<bladecurve_sample, 3> samples;
  table.eval_n(3, kX.data(), kTheta.data(), samples.data());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(samples[i].phi_mm, blade.curve.Eval(kX[i], kTheta[i]).phi_mm);
    EXPECT_EQ(samples[i].flags, blade.curve.Eval(kX[i], kTheta[i]).flags);
  }
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.rfind(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(BuiltPlugin, ThatIsBrokenIsRefusedByName) {
  const std::string good = PluginSource(TaperedBlade());
  const auto complaint = [&](const std::string& from, const std::string& to) {
    return BladeFileComplaint(Build(Replaced(good, from, to)));
  };
  EXPECT_NE(complaint("-11.0, /* a */", "-12.0, /* a */").find("values"), std::string::npos);
  EXPECT_NE(complaint("  BLADECURVE_PLUGIN_VERSION,", "  0u,").find("version 0"),
            std::string::npos);
  EXPECT_NE(complaint("  sizeof(bladecurve_plugin),", "  8u,").find("8 bytes"), std::string::npos);
  EXPECT_NE(complaint("\"tapered-rectangle\", /*", "\"circle\", /*").find("circle"),
            std::string::npos);
  EXPECT_NE(complaint("100.0, /* x_max_mm */", "10.0, /* x_max_mm */").find("x_mm"),
            std::string::npos);
  EXPECT_EQ(BladeFileComplaint(Build(good)), "");
}

TEST(Plugin, ForeignAndBrokenLibrariesAreRefusedByName) {
  WriteText(Scratch("no.so"),
            std::string("\x7f"
                        "ELF and then nothing"));
  EXPECT_NE(BladeFileComplaint(Scratch("no.so")).find("cannot be loaded"), std::string::npos);
  if (!IsInstalled("cc")) GTEST_SKIP() << "no C compiler";
  CompilePlugin("int other(void);\nint other(void) { return 1; }\n", Scratch("other.so"));
  EXPECT_NE(BladeFileComplaint(Scratch("other.so")).find("bladecurve_entry"), std::string::npos);
}

// Sets CC for one test and puts it back.
class WithCompiler {
 public:
  explicit WithCompiler(const char* name) {
    if (const char* old = std::getenv("CC")) old_ = old;
    setenv("CC", name, 1);
  }
  ~WithCompiler() {
    if (old_.empty()) {
      unsetenv("CC");
    } else {
      setenv("CC", old_.c_str(), 1);
    }
  }

 private:
  std::string old_;
};

std::string CompilerComplaint(const fs::path& library) {
  try {
    CompilePlugin("int x;\n", library);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(CompilePlugin, SaysWhatIsMissing) {
  {
    const WithCompiler none("no-such-compiler -x");
    EXPECT_NE(CompilerComplaint(Scratch("a.so")).find("no-such-compiler"), std::string::npos);
  }
  {
    const WithCompiler broken("false");
    EXPECT_NE(CompilerComplaint(Scratch("a.so")).find("failed"), std::string::npos);
  }
  EXPECT_FALSE(fs::exists(Scratch("a.so")));
  if (!IsInstalled("cc")) GTEST_SKIP() << "no C compiler";
  EXPECT_NE(CompilerComplaint(Scratch("no/such/a.so")).find("cannot write"), std::string::npos);
}

}  // namespace
}  // namespace bladecurve
