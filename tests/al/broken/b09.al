; find out where the pin really stands, use it for the next one
        TRANS   P [18 44 3 90 90 0]
        TRANS   T [25 38 4 90 90 0]
        OPEN    1
        MOVE    P
        CENTER  .1
        SAVE    C               ;the holder has been pushed this far
        MOVE    T
        OPEN    .5
        MOVE    P
        OPEN    1
        RESTORE C
        CLOSE   .1
        MOVE    T
        OPEN    .5
