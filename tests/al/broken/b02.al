; put the pin into its hole, feeling for it
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [25 38 4 90 90 0]
        OPEN    1
        MOVE    P               ;go to the pin
        CLOSE   .1
        MOVE    T               ;go to the hole
TRY:    SEARCH  .07
        MOVE    T
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6     ;no resistance in the hole
        SKIPE   23
        AOJ     TRY
        STOP    [0 0 -60]
        CHANGE  [0 0 -1] .6     ;now it should meet some
        SKIPN   23
        AOJ     TRY
        OPEN    .5
        CLOSE   .1              ;is it still there?
