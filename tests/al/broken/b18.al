; bring the pin to its hole, going round the vise
        TRANS   P [18 44 3 90 90 0]
        TRANS   T [25 38 4 90 90 0]
        TRANS   ROUND [12 30 9 90 90 0]
        TRANS   PARK [20 28 8 90 90 0]
        STAGE   "fetch the pin"
        OPEN    1
        MOVE    P
        CLOSE   .1
        STAGE   "bring it"
        MOVE    T
        VIA     ROUND           ;not through the vise
        OPEN    .5
        PARK
