"""A record matched to a target whose displacements stay: run/match RULES FILE ... --anchor 0.3g --out DIR

    run/match petsc-options/rules/srp371_approach2.csv RSN1106_KJM000.AT2 RSN1106_KJM090.AT2 --anchor 0.3g --out results/kobe

Scales each component and adds wavelets until its spectrum keeps the rules, with the peak displacement within 5 % and the
displacement at the end within 1 mm of the scaled record's. Says what it reached, and ends with status 3 where a limit or
rule is not kept. DIR has the components as records, match.csv and verdicts.csv. docs/manual/motions.md has an example.
"""

from pounding.motion_matching import arguments, carry_out

from .process import parser_of


def main() -> int:
    return carry_out(arguments(parser_of(__doc__)).parse_args())
