// SPDX-License-Identifier: BSD-3-Clause
// Broken files of labelling problems.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/problem_formats.h"
#include "support/refusal.h"
#include "toposcope/labeling/problem_writer.h"

namespace {

using namespace toposcope;
using test::refusal;
using testing::HasSubstr;

TEST(ProblemFiles, RefusalsNameThePlaceAndTheRemedy) {
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 1 2 1 10\n2\n1 0 0 1\n"); }), HasSubstr("a.wcsp:4:1: the file ends"));
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 1 2 1 10\n2\n1 5 0 0\n"); }),
              HasSubstr("a.wcsp:3:3: the index of a variable cannot be 5: it must be from 0 to 0"));
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 2 2 1 10\n2 2\n2 0 0 0 0\n"); }),
              HasSubstr("names variable 'x0' twice"));
  EXPECT_THAT(
      refusal([] { read_wcsp("a.wcsp", "p 2 2 1 10\n2 2\n2 0 1 -1 smst hard 5\n"); }),
      HasSubstr(
          "a.wcsp:3:10: the cost function 'smst' is not supported; did you mean 'MST'? Otherwise write it as a table"));
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 2 2 1 10\n2 2\n2 0 1 -1 salldiff lin 5\n"); }),
              HasSubstr("a.wcsp:3:19: the measure of 'salldiff' is 'lin'; supported are var, dec, decbi"));
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 2 2 1 10\n2 2\n2 0 1 0 1\n0 0 -3\n"); }),
              HasSubstr("are not negative"));
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 2 2 1 10\n2 2\n2 0 1 0 -1\n"); }),
              HasSubstr("is not defined before"));
  EXPECT_THAT(refusal([] { read_cfn("a.cfn", "{problem {name x mustbe 3}\nvariables {} functions {}}"); }),
              HasSubstr("a.cfn:1:25: the bound is '3'; it must be '<'"));
  EXPECT_THAT(refusal([] {
                read_cfn("a.cfn",
                         "{problem {name x mustbe <3}\nvariables {a 2}\nfunctions {f {scope [b] costs [0 1]}}}");
              }),
              HasSubstr("a.cfn:3:22: there is no variable 'b'"));
  EXPECT_THAT(refusal([] { read_cfn("a.cfn", "{problem {name x mustbe <3}"); }), HasSubstr("cut short"));
  EXPECT_THAT(refusal([] {
                read_cfn("a.cfn", "{problem {name x mustbe <3}\nvariables {a 2}\nfunctions {f {scope [a] costs [0]}}}");
              }),
              HasSubstr("function 'f' has 1 costs; its scope has 2 tuples"));
  EXPECT_THAT(refusal([] {
                read_cfn("a.cfn",
                         "{problem {name x mustbe <3}\nvariables {a 2 b 2}\nfunctions {f {scope [a b] type wsum "
                         "params {metric lin cost 1 to 2}}}}");
              }),
              HasSubstr("a.cfn:3:63: expected 'comparator' but found 'to'"));
  EXPECT_THAT(refusal([] { read_uai("a.uai", "MARKOV\n1\n2\n1\n1 0\n\n3\n1 1 1"); }),
              HasSubstr("a.uai:7:1: the function has 3 entries; the domains of its 1 variables make 2"));
  EXPECT_THAT(refusal([] { read_uai("a.uai", "MARKOV\n1\n2\n1\n1 0\n\n2\n1 -1"); }), HasSubstr("are not negative"));
  EXPECT_THAT(refusal([] { read_uai("a.uai", "MARKOV\n0\n1 0\n1 0"); }),
              HasSubstr("a.uai:3:3: the functions without variables forbid every labelling"));
  EXPECT_THAT(refusal([] { read_problem_json("a.json", "{}"); }), HasSubstr("toposcope.problem/1"));
  EXPECT_THAT(refusal([] { read_problem_json("a.json", "{\n  \"schema\": ]"); }), HasSubstr("a.json:2:13: is no JSON"));
  const std::string begin = "{\"schema\": \"toposcope.problem/1\",\n\"variables\": [\n {\"name\": \"a\", ";
  EXPECT_THAT(refusal([&] { read_problem_json("a.json", begin + "\"costs\": [0, \"x\"]}]}"); }),
              HasSubstr("a.json:3:29: 'costs' holds numbers, and null for what is forbidden"));
  EXPECT_THAT(refusal([&] { read_problem_json("a.json", begin + "\"cost\": [0]}]}"); }),
              HasSubstr("a.json:3:24: unknown key 'cost'; did you mean 'costs'?"));
  EXPECT_THAT(refusal([&] {
                read_problem_json("a.json", begin +
                                                "\"costs\": [0, 1]}],\n\"constraints\": [{\"scope\": [1], "
                                                "\"costs\": [0, 1]}]}");
              }),
              HasSubstr("a.json:4:28: there is no variable 1"));
  EXPECT_THAT(refusal([&] { read_problem_json("a.json", begin + "\"costs\": []}]}"); }), HasSubstr("has no values"));
  EXPECT_THAT(refusal([&] { read_problem_json("a.json", begin + "\"costs\": [1e999]}]}"); }), HasSubstr("1e999"));
  EXPECT_THAT(refusal([] { read_problem("a.txt"); }), HasSubstr("known are .json, .cfn, .wcsp and .uai"));
  EXPECT_THAT(refusal([] { read_problem("no-such.cfn"); }), HasSubstr("no-such.cfn: no such file"));
  LabelingProblem large;
  large.variables = {{.name = "a", .costs = {0, 1e16}}};
  EXPECT_THAT(refusal([&] { write_problem(testing::TempDir() + "/large.wcsp", large); }), HasSubstr("too large"));
}

}  // namespace
