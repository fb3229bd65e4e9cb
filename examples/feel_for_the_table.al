; The hand goes down to the table until it presses on it with 40 ounces.
        TRANS   ABOVE [25 38 .5 90 90 0]
        STAGE   "feel for the table"
        OPEN    1
        MOVE    ABOVE
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] 1 .2
