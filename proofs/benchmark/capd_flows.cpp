// The flows of flows.py by CAPD (https://github.com/CAPDGroup/CAPD): widths and CPU seconds.
// Build libcapd with its cmake (intervals: FILIB), then this with the same flags and directories.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>

#include "capd/capdlib.h"

using namespace capd;

struct Problem {
  const char* name;
  const char* field;
  IVector start;
  std::function<void(IMap&)> set;
};

static void follow(const Problem& problem, double time, int order) {
  const clock_t began = clock();
  try {
    IMap field(problem.field);
    problem.set(field);
    IOdeSolver solver(field, order);
    ITimeMap flow(solver);
    C1HORect2Set set(problem.start);
    const int n = problem.start.dimension();
    IMatrix derivative(n, n);
    const IVector end = flow(interval(time), set, derivative);
    double width = 0;
    for (int i = 0; i < n; ++i) width = std::max(width, end[i].rightBound() - end[i].leftBound());
    printf("%-11s %5g %.1e", problem.name, time, width);
  } catch (const std::exception& error) {
    printf("%-11s %5g %.120s", problem.name, time, error.what());
  }
  printf(" %.4f s\n", double(clock() - began) / CLOCKS_PER_SEC);
}

int main() {
  const auto nothing = [](IMap&) {};
  const interval zero(0), one(1);
  const Problem problems[] = {
      {"Lorenz", "par:b;var:x,y,z;fun:10*(y-x),x*(28-z)-y,x*y-b*z;", {one, one, one},
       [](IMap& f) { f.setParameter("b", interval(8) / 3.); }},
      {"Roessler", "par:a,b;var:x,y,z;fun:-(y+z),x+b*y,b+z*(x-a);",
       {zero, interval(-8), interval(3) / 100.},
       [](IMap& f) {
         f.setParameter("a", interval(57) / 10.);
         f.setParameter("b", interval(1) / 5.);
       }},
      {"Van der Pol", "var:x,v;fun:v,(1-x^2)*v-x;", {interval(2), zero}, nothing},
      {"pendulum", "var:x,v;fun:v,-sin(x);", {one, zero}, nothing},
      {"x'' = -x", "var:x,v;fun:v,-x;", {one, zero}, nothing},
  };
  for (const auto& problem : problems)
    for (double time : {1., 10., 100.}) follow(problem, time, 20);
}
