; One pin into one hole, by the search of the listing of 1973: for comparison on the insertion bench.
;
; Inches, ounces, degrees. Positions are taught, in the file beside this one.

        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5     ;draw it out of its holder
        MOVE    T

        STAGE   "insert it"
        SEARCH  .07
L:      MOVE    T               ;GO TO THE HOLE
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6     ;TRY TO GO DOWN WITHOUT MEETING RESISTANCE
        SKIPE   23
        AOJ     L
        STOP    [0 0 -60]
        CHANGE  [0 0 -1] .6     ;IT SHOULD MEET SOME RESISTANCE
        SKIPN   23
        AOJ     L
