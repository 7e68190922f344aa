/* Plans: what is said of shards is what dealing them comes to, and what was measured is used. */
#include <gsl/gsl_test.h>

#include "harness/experiments/deal.h"
#include "harness/experiments/forecast.h"
#include "harness/experiments/test/number_work.h"
#include "harness/records/test/folder.h"

/* One shard is the sum; as many as batches take as long as the dearest; none is shorter than the
 * sum by its processes. */
static void bounds(void)
{
    numbers_work here;
    double all = 0, dearest = 0;
    numbers_begin(&here);
    for (int i = 0; i < NUMBERS_BATCHES; i++) {
        all += here.cost[i];
        dearest = fmax(dearest, here.cost[i]);
    }
    for (int shards = 1; shards <= 64; shards++)
        for (int jobs = 1; jobs <= 3; jobs++) {
            forecast plan;
            fault f = {""};
            const double longest[] = {all / (shards * jobs), dearest};
            gsl_test(forecast_of(&here.w, here.cost, shards, jobs, &plan, &f) != STATUS_OK,
                     "%d shards of %d: %s", shards, jobs, f.text);
            gsl_test(plan.longest < fmax(longest[0], longest[1]) * (1 - 1e-12),
                     "%d shards of %d: not shorter than the work", shards, jobs);
            /* of any list that is walked so: Graham's bound */
            gsl_test(plan.longest > longest[0] + dearest, "%d shards of %d: dealt", shards, jobs);
            gsl_test_rel(plan.efficiency, longest[0] / plan.longest, 1e-12, "efficiency");
            gsl_test(plan.most * shards < NUMBERS_BATCHES, "all batches are dealt");
        }
}

/* Of one process a shard, the longest is the largest sum that the dealing gives. */
static void as_dealt(void)
{
    numbers_work here;
    int shard[NUMBERS_BATCHES], count[7] = {0}, most = 0;
    double seconds[NUMBERS_BATCHES], sum[7] = {0}, longest = 0;
    forecast plan;
    fault f = {""};
    numbers_begin(&here);
    gsl_test(deal_out(NUMBERS_BATCHES, here.cost, 7, shard) != 0, "dealt");
    for (int i = 0; i < NUMBERS_BATCHES; i++) {
        seconds[i] = here.cost[i] * (1 + i % 3); /* not what was expected */
        sum[shard[i]] += seconds[i];
        count[shard[i]]++;
    }
    for (int k = 0; k < 7; k++) {
        longest = fmax(longest, sum[k]);
        most = count[k] > most ? count[k] : most;
    }
    gsl_test(forecast_of(&here.w, seconds, 7, 1, &plan, &f) != STATUS_OK, "%s", f.text);
    gsl_test_rel(plan.longest, longest, 1e-12, "the longest shard by what batches take");
    gsl_test_int(plan.most, most, "most batches of a shard");
}

/* Without a folder the costs; from batches what they took, and of those missing as much more. */
static void measured(void)
{
    numbers_work here;
    const test_folder folder = folder_make();
    shard_outcome done;
    forecast_seconds s;
    fault f = {""};
    double cost = 0, all = 0;
    numbers_begin(&here);
    here.n.busy = 0.02;
    gsl_test(forecast_read(&here.w, NULL, &s, &f) != STATUS_OK || s.measured != 0 || s.factor != 1,
             "no folder: %s", f.text);
    gsl_test(memcmp(s.seconds, here.cost, sizeof here.cost) != 0, "the costs themselves");
    forecast_free(&s);
    gsl_test(numbers_shard(&here, folder.path, 0, 2, &done, &f) != STATUS_OK, "half: %s", f.text);
    gsl_test(forecast_read(&here.w, folder.path, &s, &f) != STATUS_OK, "read: %s", f.text);
    gsl_test_int(s.measured, done.mine, "those that are there");
    for (int i = 0; i < NUMBERS_BATCHES; i++)
        if (s.seconds[i] != here.cost[i] * s.factor) {
            cost += here.cost[i];
            all += s.seconds[i];
        }
    gsl_test(all < 0.5 * here.n.busy * done.mine, "the time of the processor: %g s", all);
    gsl_test_rel(s.factor, all / cost, 1e-9, "measured by expected");
    gsl_test(!(1 <= s.median && s.median <= s.tenth), "factors %g, %g", s.median, s.tenth);
    forecast_free(&s);
    here.w.build = "build 2";
    gsl_test_int((int)forecast_read(&here.w, folder.path, &s, &f), STATUS_REFUSED,
                 "another build's: %s", f.text);
    forecast_free(&s);
    folder_remove(&folder);
}

int main(void)
{
    bounds();
    as_dealt();
    measured();
    return gsl_test_summary();
}
