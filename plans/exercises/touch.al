; Exercise `touch`: stand the pin on the plate, gently. `handeye exercise touch` explains it.
;
; This program trusts the plan: it moves down by a fixed distance. Let the hand feel the plate instead.
; Inches, ounces, degrees. The positions are taught, in the file next to this one.

        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5     ;draw it out of its holder
        MOVE    HOLE

        STAGE   "stand it on the plate"
        CHANGE  [0 0 -1] .13 .11
