/* Siconos on the machines with rigid stops:
 *
 *     machine_siconos SCHEME NUMBER PROBLEM SECONDS          prints {"rate": ...}, events per second
 *     machine_siconos SCHEME NUMBER PROBLEM --starts FILE    prints the first event times of each start
 *
 * SCHEME NUMBER is `events TOLERANCE`, the strategy EventDriven with LSODAR and root finding, or `steps N`, Moreau-Jean time
 * stepping with N steps in a forcing period. Time stepping does not locate impacts, so the time of an event is the end of its
 * step. EventDriven does not treat walls that move. For a problem that is not treated the rate is null, and nothing is
 * printed for its starts. The problems are in ../python/machine_problems.py too. */
#include <SiconosKernel.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace {

constexpr double TAU = 6.283185307179586476925286766559;
constexpr int FIRST = 5;         // event times that `--starts` prints
constexpr int DROPPED = 20;      // events before a rate is taken
constexpr double HORIZON = 60.0; // time for which a start is followed
constexpr double ENDLESS = 1e9;
constexpr double CONTACT = 1e-9; // gap below which EventDriven takes a stop as touched
constexpr double RESTART = 10.0; // forcing periods after which EventDriven stops without an event

struct Scheme {
    bool events;   // or steps
    double number; // tolerance, or steps in a forcing period
};

using Numbers = std::vector<double>;

/* A term of the motion of a wall: cosine cos(order w t) + sine sin(order w t). */
struct Harmonic {
    int order;
    double cosine, sine;
};

/* A rigid stop: its gap is `gap - direction.q - r(t)`, r the sum of the harmonics. */
struct Wall {
    Numbers direction;
    double gap, restitution;
    std::vector<Harmonic> motion;
};

/* A machine with unit masses, and its usual start. */
struct Problem {
    std::vector<Numbers> stiffness, damping;
    Numbers force;
    double frequency;
    std::vector<Wall> walls;
    Numbers q, v;
};

Problem chain()
{
    return {{{1.0, -1.0}, {-1.0, 2.0}}, {{0.03, -0.03}, {-0.03, 0.06}}, {0.0, 1.0}, 1.8,
            {{{1.0, 0.0}, 0.2, 0.8, {}}}, {-0.5, 0.1}, {0.0, 0.0}};
}

Problem beam()
{
    const Numbers wave_numbers = {1.875104068711961, 4.694091132974175, 7.854757438237613,
                                  10.995540734875467, 14.13716839104647, 17.278759532088237};
    const size_t n = wave_numbers.size();
    const std::vector<Numbers> zero(n, Numbers(n, 0.0));
    Problem p{zero, zero, Numbers(n), 1.3, {{Numbers(n), 0.5, 0.95, {}}}, Numbers(n, 0.0), Numbers(n, 0.0)};
    for (size_t i = 0; i < n; i++) {
        const double k = wave_numbers[i], omega = std::pow(k / wave_numbers[0], 2);
        const double sigma = (std::cosh(k) + std::cos(k)) / (std::sinh(k) + std::sin(k));
        p.stiffness[i][i] = omega * omega;
        p.damping[i][i] = 0.02 * omega;
        p.force[i] = 0.5 * 2.0 * sigma / k;
        p.walls[0].direction[i] = i % 2 == 0 ? 2.0 : -2.0;
    }
    return p;
}

Problem ball()
{
    return {{{0.0}}, {{0.0}}, {0.0}, 1.0,
            {{{-1.0}, 1.0, 0.9, {{1, 0.0, -0.3}}}, {{1.0}, 1.0, 0.9, {{1, 0.2, 0.0}, {2, 0.0, 0.1}}}}, {0.1}, {0.9}};
}

/* The force as Siconos calls it, which has no room for an argument of ours. */
Numbers current_force;
double current_frequency;

void external_force(double time, unsigned int size, double *force, unsigned int, double *)
{
    const double s = std::sin(current_frequency * time);
    for (unsigned int i = 0; i < size; i++)
        force[i] = current_force[i] * s;
}

/* The gap of a wall that moves. */
class MovingWall : public LagrangianRheonomousR {
    const Wall &wall;
    const double frequency;

public:
    MovingWall(const Wall &w, double f) : wall(w), frequency(f)
    {
        _jachq = std::make_shared<SimpleMatrix>(1, w.direction.size());
        _hDot = std::make_shared<SiconosVector>(1);
    }

    void computeh(double time, const BlockVector &q, BlockVector &, SiconosVector &y) override
    {
        double gap = wall.gap;
        for (size_t i = 0; i < wall.direction.size(); i++)
            gap -= wall.direction[i] * q.getValue(i);
        for (const Harmonic &h : wall.motion) {
            const double a = h.order * frequency * time;
            gap -= h.cosine * std::cos(a) + h.sine * std::sin(a);
        }
        y.setValue(0, gap);
    }

    void computehDot(double time, const BlockVector &, BlockVector &) override
    {
        double rate = 0.0;
        for (const Harmonic &h : wall.motion) {
            const double w = h.order * frequency, a = w * time;
            rate -= w * (h.sine * std::cos(a) - h.cosine * std::sin(a));
        }
        _hDot->setValue(0, rate);
    }

    void computeJachq(double, const BlockVector &, BlockVector &) override
    {
        for (size_t i = 0; i < wall.direction.size(); i++)
            _jachq->setValue(0, i, -wall.direction[i]);
    }
};

SP::SiconosVector vector(const Numbers &numbers)
{
    auto v = std::make_shared<SiconosVector>(numbers.size());
    for (size_t i = 0; i < numbers.size(); i++)
        v->setValue(i, numbers[i]);
    return v;
}

SP::SimpleMatrix matrix(const std::vector<Numbers> &rows)
{
    auto m = std::make_shared<SimpleMatrix>(rows.size(), rows[0].size());
    for (size_t i = 0; i < rows.size(); i++)
        for (size_t j = 0; j < rows[i].size(); j++)
            m->setValue(i, j, rows[i][j]);
    return m;
}

/* A motion from event to event. */
class Motion {
    const double until;
    std::vector<SP::Interaction> interactions;
    std::vector<bool> touched; // by time stepping, in the step before
    std::shared_ptr<TimeStepping> stepping;
    std::shared_ptr<EventDriven> driven;

    bool next_by_steps()
    {
        while (stepping->hasNextEvent() && stepping->nextTime() < until) {
            Numbers approach;
            for (const auto &interaction : interactions)
                approach.push_back(interaction->y(1)->getValue(0));
            stepping->computeOneStep();
            const double end = stepping->nextTime();
            bool struck = false;
            for (size_t i = 0; i < interactions.size(); i++) {
                const bool touches = interactions[i]->lambda(1)->getValue(0) > 0.0;
                struck |= touches && !touched[i] && approach[i] < 0.0 && interactions[i]->y(1)->getValue(0) > 0.0;
                touched[i] = touches;
            }
            stepping->nextStep();
            if (struck) {
                time = end;
                return true;
            }
        }
        return false;
    }

    bool next_by_roots()
    {
        while (driven->hasNextEvent() && driven->startingTime() < until) {
            driven->advanceToEvent();
            const bool struck = driven->eventsManager()->nextEvent()->getType() == NS_EVENT;
            const double at = driven->eventsManager()->nextEvent()->getDoubleTimeOfEvent();
            driven->processEvents();
            if (struck) {
                time = at;
                return at < until;
            }
        }
        return false;
    }

public:
    double time = 0.0;

    Motion(const Problem &problem, const Scheme &scheme, const Numbers &q, const Numbers &v, double horizon)
        : until(horizon), touched(problem.walls.size(), false)
    {
        const size_t n = q.size();
        auto mass = std::make_shared<SimpleMatrix>(n, n);
        mass->eye();
        auto bodies = std::make_shared<LagrangianLinearTIDS>(vector(q), vector(v), mass, matrix(problem.stiffness),
                                                             matrix(problem.damping));
        current_force = problem.force;
        current_frequency = problem.frequency;
        bodies->setComputeFExtFunction(external_force);
        auto system = std::make_shared<NonSmoothDynamicalSystem>(0.0, horizon);
        system->insertDynamicalSystem(bodies);
        for (const Wall &wall : problem.walls) {
            SP::Relation relation;
            if (wall.motion.empty()) {
                Numbers away;
                for (const double w : wall.direction)
                    away.push_back(-w);
                relation = std::make_shared<LagrangianLinearTIR>(matrix({away}), vector({wall.gap}));
            } else {
                relation = std::make_shared<MovingWall>(wall, problem.frequency);
            }
            auto law = std::make_shared<NewtonImpactNSL>(wall.restitution);
            interactions.push_back(std::make_shared<Interaction>(law, relation));
            system->link(interactions.back(), bodies);
        }
        const double period = TAU / problem.frequency;
        if (scheme.events) {
            auto times = std::make_shared<TimeDiscretisation>(0.0, RESTART * period);
            driven = std::make_shared<EventDriven>(system, times);
            auto lsodar = std::make_shared<LsodarOSI>();
            driven->insertIntegrator(lsodar);
            driven->insertNonSmoothProblem(std::make_shared<LCP>(), SICONOS_OSNSP_ED_IMPACT);
            driven->insertNonSmoothProblem(std::make_shared<LCP>(), SICONOS_OSNSP_ED_SMOOTH_ACC);
            driven->setToleranceED(CONTACT);
            driven->initialize();
            // after initialize(), which sets the defaults
            lsodar->setTol(1, scheme.number, 1e-12);
            lsodar->setMaxNstep(100000);
        } else {
            auto times = std::make_shared<TimeDiscretisation>(0.0, period / scheme.number);
            stepping = std::make_shared<TimeStepping>(system, times, std::make_shared<MoreauJeanOSI>(0.5),
                                                      std::make_shared<LCP>());
            stepping->initialize();
        }
    }

    /* Goes on to the next event; false where there is none before the horizon. */
    bool next_event()
    {
        return driven ? next_by_roots() : next_by_steps();
    }
};

double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void starts(const Problem &problem, const Scheme &scheme, const char *path)
{
    std::ifstream file(path);
    const auto n = static_cast<long>(problem.q.size());
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        Numbers start;
        for (double x; words >> x;)
            start.push_back(x);
        Motion motion(problem, scheme, {start.begin(), start.begin() + n}, {start.begin() + n, start.end()}, HORIZON);
        for (int i = 0; i < FIRST && motion.next_event(); i++)
            std::printf(i > 0 ? " %.17g" : "%.17g", motion.time);
        std::printf("\n");
    }
}

void rate(const Problem &problem, const Scheme &scheme, double seconds)
{
    Motion motion(problem, scheme, problem.q, problem.v, ENDLESS);
    for (int i = 0; i < DROPPED; i++)
        motion.next_event();
    long events = 0;
    double elapsed = 0.0;
    const double begin = now();
    while (elapsed < seconds && motion.next_event()) {
        events++;
        elapsed = now() - begin;
    }
    std::printf("{\"rate\": %.17g}\n", static_cast<double>(events) / elapsed);
}

} // namespace

int main(int count, char **words)
{
    if (count < 5)
        return 2;
    const Scheme scheme{std::string(words[1]) == "events", std::atof(words[2])};
    const std::string name = words[3];
    const bool with_starts = std::string(words[4]) == "--starts";
    if (name != "chain" && name != "beam" && (name != "ball" || scheme.events)) {
        if (!with_starts)
            std::printf("{\"rate\": null}\n");
        return 0;
    }
    const Problem problem = name == "chain" ? chain() : name == "beam" ? beam() : ball();
    try {
        if (with_starts)
            starts(problem, scheme, words[5]);
        else
            rate(problem, scheme, std::atof(words[4]));
    } catch (...) {
        Siconos::exception::process();
        return 1;
    }
    return 0;
}
