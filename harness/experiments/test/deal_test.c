/* Digests, and work cut and dealt. */
#include <gsl/gsl_test.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/experiments.h"
#include "harness/records/records.h"

/* The examples of FIPS 180-4. */
static void known_digests(void)
{
    static const struct {
        const char *text;
        int times;
        const char *right;
    } known[] = {
        {"", 1, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
        {"abc", 1, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
        {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 1,
         "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
        {"aaaaaaaaaa", 100000, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        char text[DIGEST_TEXT];
        digest d = digest_begin();
        for (int k = 0; k < known[i].times; k++)
            digest_add(&d, known[i].text, strlen(known[i].text));
        digest_text(&d, text);
        gsl_test(strcmp(text, known[i].right) != 0, "digest %zu: %s", i, text);
    }
}

static void same_numbers(void)
{
    char plus[DIGEST_TEXT], minus[DIGEST_TEXT], other[DIGEST_TEXT];
    digest a = digest_begin(), b = digest_begin(), c = digest_begin();
    digest_add_number(&a, 0.0);
    digest_add_number(&b, -0.0);
    digest_add_number(&c, 5e-324);
    digest_text(&a, plus);
    digest_text(&b, minus);
    digest_text(&c, other);
    gsl_test(strcmp(plus, minus) != 0, "-0 is 0");
    gsl_test(strcmp(plus, other) == 0, "the least number is not 0");
    a = b = digest_begin();
    digest_add_text(&a, "ab");
    digest_add_text(&a, "c");
    digest_add_text(&b, "a");
    digest_add_text(&b, "bc");
    digest_text(&a, plus);
    digest_text(&b, minus);
    gsl_test(strcmp(plus, minus) == 0, "texts keep their ends");
}

static void cut(void)
{
    static const double cost[] = {0.2, 0.2, 0.2, 3, 0.1, 0.4, 0.1};
    int first[8];
    gsl_test_int(deal_cut(7, cost, 0.5, first), 5, "batches");
    static const int right[] = {0, 2, 3, 4, 6, 7};
    gsl_test(memcmp(first, right, sizeof right) != 0, "cut where the next would be too much");
    gsl_test_int(deal_cut(0, cost, 0.5, first), 0, "of nothing no batch");
}

/* Each batch to one shard, none much longer than another, the same each time. */
static void dealt(void)
{
    enum { BATCHES = 500, SHARDS = 7 };
    double cost[BATCHES], sum[SHARDS] = {0}, least = 1e300, most = 0;
    int shard[BATCHES], again[BATCHES];
    for (int i = 0; i < BATCHES; i++)
        cost[i] = 0.1 + (i * 37 % 101) * 0.01 + (i % 50 == 0) * 4;
    gsl_test(deal_out(BATCHES, cost, SHARDS, shard) != 0 ||
                 deal_out(BATCHES, cost, SHARDS, again) != 0,
             "dealt");
    gsl_test(memcmp(shard, again, sizeof shard) != 0, "the same again");
    for (int i = 0; i < BATCHES; i++) {
        gsl_test(shard[i] < 0 || shard[i] >= SHARDS, "batch %d has a shard", i);
        sum[shard[i]] += cost[i];
    }
    for (int k = 0; k < SHARDS; k++) {
        least = sum[k] < least ? sum[k] : least;
        most = sum[k] > most ? sum[k] : most;
    }
    gsl_test(most > 1.01 * least, "shards end together: %g to %g", least, most);
}

/* As by the rule itself: the dearest that is left to the first of the shards that have least. */
static void dealt_by_the_rule(void)
{
    enum { BATCHES = 300, MOST = 40 };
    double cost[BATCHES];
    int shard[BATCHES], order[BATCHES];
    for (int i = 0; i < BATCHES; i++)
        cost[i] = 1 + i * 7 % 4; /* many cost the same */
    deal_order(BATCHES, cost, order);
    for (int shards = 1; shards <= MOST; shards++) {
        double sum[MOST] = {0};
        int wrong = deal_out(BATCHES, cost, shards, shard) != 0;
        for (int i = 0; i < BATCHES; i++) {
            int to = 0;
            for (int k = 1; k < shards; k++)
                to = sum[k] < sum[to] ? k : to;
            wrong += shard[order[i]] != to;
            sum[to] += cost[order[i]];
        }
        gsl_test_int(wrong, 0, "%d shards", shards);
    }
}

int main(void)
{
    dealt_by_the_rule();
    known_digests();
    same_numbers();
    cut();
    dealt();
    return gsl_test_summary();
}
