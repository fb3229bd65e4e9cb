; Exercise `gently`: put the pin into its hole without a blow. `handeye exercise gently` explains it.
;
; This is the search of the listing of 1973. It finds the hole, but strikes the plate at 1 in/s.
; Inches, ounces, degrees. The positions are taught, in the file next to this one.

        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5     ;draw it out of its holder
        MOVE    HOLE

        STAGE   "insert it"
        SEARCH  .07
L:      MOVE    HOLE
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6     ;try to go down without meeting resistance
        SKIPE   23
        AOJ     L
        STOP    [0 0 -60]
        CHANGE  [0 0 -1] .6     ;it should meet some resistance
        SKIPN   23
        AOJ     L
