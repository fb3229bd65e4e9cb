; It touches the plate, and lets the pin fall where it should go into its holder.
        OPEN    1
        MOVE    PIN
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    HOLE
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .3 .11
        CHANGE  [0 0 1] 1
        MOVE    LIFT
        OPEN    1
