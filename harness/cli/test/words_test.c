/* Every word that the program prints as a result is explained in the glossary: the words come from
 * the program's own tables. */
#include <gsl/gsl_test.h>
#include <stdlib.h>

#include "elements/shared/choice.h"
#include "harness/experiments/experiments.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

static glossary words;

static void explained(const char *what, const char *word)
{
    gsl_test(glossary_find(&words, word) == NULL, "%s '%s'", what, word);
}

static void all_of(const char *what, const char *choices)
{
    char word[GLOSSARY_WORD];
    for (int i = 0; glossary_part(choices, i, word); i++)
        explained(what, word);
}

int main(void)
{
    const char *packed = getenv("BEAMWORK_TRUTHS");
    fault f = {""};
    gsl_test(glossary_read(packed != NULL ? packed : "build/truths.h5", &words, &f) != STATUS_OK,
             "the glossary is read %s", f.text);
    for (int i = 0; i < VERDICT_KINDS; i++)
        explained("verdict", verdict_name((verdict_kind)i));
    for (int i = 1; i < LIMIT_KINDS; i++) /* but "none" */
        explained("kind of limit", limit_kind_name((limit_kind)i));
    for (int i = 0; i <= STATUS_NO_VALUE; i++)
        explained("status", status_name((status)i));
    for (int i = 0; i < OUTCOME_KINDS; i++)
        explained("outcome", outcome_name((outcome_kind)i));
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1)
        explained("feature", feature_name(bit));
    for (int i = 0; i <= SCENE_ROTATION; i++)
        explained("analysis", scene_analysis_name((scene_analysis_kind)i));
    for (int i = 0; i < COMPARISON_KINDS; i++)
        explained("change", comparison_kind_names[i]);
    for (int i = 0; i <= AGAINST_SLOWER; i++)
        explained("comparison of times", against_name((against_outcome)i));
    all_of("kind of truth", truth_kinds);
    all_of("theory of shear", SCENE_SHEAR_THEORIES);
    all_of("moment convention", SCENE_MOMENTS_CHOICES);
    all_of("model", "same|other");
    all_of("group of analyses", "statics|vibration|buckling");
    glossary_free(&words);
    return gsl_test_summary();
}
